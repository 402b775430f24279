// data.js - data of the page: the numbers, and pictures that are unpacked when they are shown.
'use strict';

const report = JSON.parse(document.getElementById('report').textContent);
const pictures = JSON.parse(document.getElementById('pictures').textContent);

// The float of every half float's bit pattern.
const halfFloats = (() => {
  const table = new Float32Array(65536);
  for (let bits = 0; bits < 65536; ++bits) {
    const sign = bits & 0x8000 ? -1 : 1;
    const exponent = bits >> 10 & 31, mantissa = bits & 1023;
    if (exponent === 31) table[bits] = mantissa ? NaN : sign * Infinity;
    else if (exponent === 0) table[bits] = sign * mantissa * 2 ** -24;
    else table[bits] = sign * (1 + mantissa / 1024) * 2 ** (exponent - 15);
  }
  return table;
})();

async function inflate(text) {
  const bytes = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// One picture from its planes: low bytes, then high bytes; the later channels are differences to the first.
function interleave(bytes, start, texels, channels) {
  const data = new Float32Array(texels * channels);
  for (let c = 0; c < channels; ++c) {
    const low = start + 2 * c * texels, high = low + texels;
    for (let i = 0; i < texels; ++i) {
      let bits = bytes[low + i] | bytes[high + i] << 8;
      if (c > 0) bits = bits + (bytes[start + i] | bytes[start + texels + i] << 8) & 0xffff;
      data[i * channels + c] = halfFloats[bits];
    }
  }
  return data;
}

async function unpackNow(entry) {
  const bytes = await inflate(document.getElementById(entry.id).textContent);
  const texels = entry.width * entry.height;
  const found = {};
  let start = 0;
  entry.names.forEach((name, i) => {
    const channels = entry.channels[i];
    found[name] = {width: entry.width, height: entry.height, channels, data: interleave(bytes, start, texels, channels)};
    start += 2 * channels * texels;
  });
  return found;
}

// The pictures of an entry by name. The last few stay unpacked.
const unpacked = new Map();
function unpack(entry) {
  const known = unpacked.get(entry.id) || unpackNow(entry);
  unpacked.delete(entry.id);
  unpacked.set(entry.id, known);
  if (unpacked.size > 24) unpacked.delete(unpacked.keys().next().value);
  return known;
}

// The mean of a texel's channels.
function meanAt(picture, texel) {
  let sum = 0;
  for (let c = 0; c < picture.channels; ++c) sum += picture.data[texel * picture.channels + c];
  return sum / picture.channels;
}

// Candidate minus reference as a share of the reference's mean.
function relativeError(candidate, reference, mean) {
  const data = new Float32Array(candidate.width * candidate.height);
  for (let i = 0; i < data.length; ++i) data[i] = (meanAt(candidate, i) - meanAt(reference, i)) / mean;
  return {width: candidate.width, height: candidate.height, channels: 1, data};
}

function scaledBy(picture, factor) {
  return {...picture, data: picture.data.map(value => value * factor)};
}
