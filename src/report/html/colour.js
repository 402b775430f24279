// colour.js - numbers to colours. The signed map runs from blue (darker than the reference) over near white to
// brown (brighter), which every kind of colour vision tells apart and which differs in lightness at both ends.

const signedStops = [[8, 40, 92], [36, 104, 172], [134, 182, 220], [243, 243, 240], [240, 178, 106], [194, 96, 18], [96, 38, 6]];
const noiseStops = [[18, 14, 40], [70, 36, 110], [150, 48, 110], [220, 98, 70], [250, 176, 84], [254, 236, 180]];

function ramp(stops, share) {
  const at = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const low = Math.min(Math.floor(at), stops.length - 2), part = at - low;
  return stops[low].map((value, c) => value + (stops[low + 1][c] - value) * part);
}

const rampTable = stops => Array.from({length: 257}, (_, i) => ramp(stops, i / 256));
const signedTable = rampTable(signedStops), noiseTable = rampTable(noiseStops);

function cssRamp(stops) {
  return 'linear-gradient(to right,' + stops.map(stop => `rgb(${stop})`).join(',') + ')';
}

// Linear light to sRGB, 8 bits.
function display(linear) {
  if (!(linear > 0)) return 0;
  const value = Math.min(linear, 1);
  return 255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055);
}

// The colour of one texel of a layer, or null where there is nothing.
function lightColour(layer, texel, look) {
  const gain = 2 ** look.exposure, {data, channels} = layer.picture;
  const rgb = [0, 1, 2].map(c => data[texel * channels + Math.min(c, channels - 1)]);
  return rgb.some(Number.isNaN) ? null : rgb.map(value => display(gain * value));
}

function tableColour(table, share) {
  return Number.isNaN(share) ? null : table[Math.round(256 * Math.min(Math.max(share, 0), 1))];
}

const colourOf = {
  light: lightColour,
  signed: (layer, texel, look) => tableColour(signedTable, 0.5 + 0.5 * layer.picture.data[texel] / look.scale),
  noise: (layer, texel, look) => tableColour(noiseTable, layer.picture.data[texel] / look.scale),
};

// Draws a layer texel by texel; texels that do not count stay transparent.
function paint(canvas, layer, look) {
  const {width, height} = layer.picture, colour = colourOf[layer.kind];
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext('2d'), image = context.createImageData(width, height);
  for (let i = 0; i < width * height; ++i) {
    const rgb = colour(layer, i, look);
    if (!rgb) continue;
    image.data.set(rgb, 4 * i);
    image.data[4 * i + 3] = 255;
  }
  context.putImageData(image, 0, 0);
}
