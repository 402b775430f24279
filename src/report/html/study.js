// study.js - error against bytes, error by tilt, the table, and the spheres.

const study = JSON.parse(document.getElementById('study').textContent);
const fit = study.encodings.filter(one => one.rms);
const share = value => hundredths(100 * value) + '\u00a0%';
const shownAtFirst = ['flat', 'rnm-vrad', 'sh2', 'zh3 K=2, 8 bits, mono', 'h6', 'sh3'];
let limit = Math.min(1, study.tilt_limits.length - 1);

// What no other encoding beats in both bytes and error, from the smallest on.
function frontier(at) {
  const sorted = [...fit].sort((a, b) => a.bytes - b.bytes || a.rms[at] - b.rms[at]);
  return sorted.filter((one, i) => sorted.slice(0, i).every(before => before.rms[at] > one.rms[at]));
}

// Lines across for the errors; `y` maps them to places.
function levels(axis, left, right, y) {
  return axis.ticks.map(tick => svg('g', {class: tick === 0 ? 'zero' : 'grid'},
    svg('line', {x1: left, x2: right, y1: y(tick), y2: y(tick)}),
    svg('text', {x: left - 6, y: y(tick) + 4, 'text-anchor': 'end'}, share(tick))));
}

function plotOfBytes() {
  const width = 680, height = 360, left = 54, right = width - 96, bottom = height - 40;
  const errors = axisOf(fit.map(one => one.rms[limit])), bytes = axisOf(fit.map(one => one.bytes));
  const x = value => left + value / bytes.high * (right - left), y = value => bottom - value / errors.high * (bottom - 14);
  const best = frontier(limit);
  const named = fit.filter(one => best.includes(one) || one.label.startsWith('rnm'))
    .map(one => ({one, x: x(one.bytes) + 7, y: y(one.rms[limit]) + 4})).sort((a, b) => b.y - a.y);
  named.forEach((name, i) => {  // from the bottom up, no name over another
    for (const below of named.slice(0, i)) if (Math.abs(below.x - name.x) < 150 && below.y - name.y < 13) name.y = below.y - 13;
  });
  return svg('svg', {class: 'chart', viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': 'Error against bytes of a texel'},
    levels(errors, left, right, y),
    bytes.ticks.map(tick => svg('text', {x: x(tick), y: bottom + 16, 'text-anchor': 'middle'}, String(tick))),
    svg('polyline', {points: best.map(one => `${x(one.bytes)},${y(one.rms[limit])}`).join(' '), class: 'path'}),
    fit.map(one => svg('g', {class: 'point', opacity: named.some(name => name.one === one) ? 1 : 0.45},
      title(`${one.label}: ${one.bytes} bytes, ${one.bakes} bakes, ${share(one.rms[limit])}`),
      svg('circle', {cx: x(one.bytes), cy: y(one.rms[limit]), r: 4}))),
    named.map(name => svg('text', {x: name.x, y: name.y, class: 'name'}, name.one.label)),
    svg('text', {x: (left + right) / 2, y: height - 6, 'text-anchor': 'middle'}, 'bytes of a texel'));
}

function plotOfTilts(shown) {
  const width = 680, height = 320, left = 54, right = width - 190, bottom = height - 40;
  const lines = fit.filter(one => shown.has(one.label));
  const errors = axisOf(lines.flatMap(one => one.rms));
  const x = i => left + 12 + i / (study.tilt_limits.length - 1) * (right - left - 24);
  const y = value => bottom - value / errors.high * (bottom - 14);
  const ends = lines.map(line => ({line, at: y(line.rms[study.tilt_limits.length - 1])})).sort((a, b) => a.at - b.at);
  ends.forEach((end, i) => { if (i) end.at = Math.max(end.at, ends[i - 1].at + 14); });  // names do not cover each other
  const colour = line => hues[lines.indexOf(line) % hues.length];
  return svg('svg', {class: 'chart', viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': 'Error by the tilt of the normal'},
    levels(errors, left, right, y),
    study.tilt_limits.map((degrees, i) => svg('text', {x: x(i), y: bottom + 16, 'text-anchor': 'middle'}, `≤ ${degrees}°`)),
    ends.map(({line, at}) => svg('g', {}, title(line.label),
      svg('polyline', {points: line.rms.map((rms, i) => `${x(i)},${y(rms)}`).join(' '), fill: 'none', stroke: colour(line), 'stroke-width': 2}),
      svg('text', {x: right + 6, y: at + 4, class: 'name'},
        svg('tspan', {fill: colour(line)}, '● '), line.label))),
    svg('text', {x: (left + right) / 2, y: height - 6, 'text-anchor': 'middle'}, 'tilt of the normal off the surface'));
}

function table() {
  return el('div', {class: 'scroll'}, el('table', {},
    el('thead', {}, el('tr', {}, el('th', {}, 'encoding'), el('th', {}, 'bakes'), el('th', {}, 'bytes'),
      study.tilt_limits.map(degrees => el('th', {}, `≤ ${degrees}°`)), el('th', {}, 'flat bias'))),
    el('tbody', {}, fit.map(one => el('tr', {}, el('th', {class: 'text'}, one.label), el('td', {}, String(one.bakes)),
      el('td', {}, String(one.bytes)), one.rms.map(rms => el('td', {}, share(rms))), el('td', {}, signedPercent(one.flat_bias)))))));
}

function probeTable() {
  return el('section', {}, el('h2', {}, 'The whole sphere'),
    el('p', {class: 'quiet'}, `E/π of all directions at normals of all directions, mean ${number(study.probe.mean)}. “By texel” counts texels of the `
      + 'picture alike, as Probulator’s reports do; “by solid angle” counts directions alike.'),
    el('div', {class: 'scroll'}, el('table', {class: 'numbers'},
      el('thead', {}, el('tr', {}, ['encoding', 'numbers', 'RMS by texel', 'RMS by solid angle', 'of the mean', 'bias'].map(name => el('th', {}, name)))),
      el('tbody', {}, study.probe.encodings.map(one => el('tr', {}, el('th', {class: 'text'}, one.encoding), el('td', {}, String(one.numbers)),
        el('td', {}, number(one.rms_by_texel)), el('td', {}, number(one.rms_by_solid_angle)),
        el('td', {}, share(one.rms_by_solid_angle / study.probe.mean)), el('td', {}, signedPercent(one.bias / study.probe.mean))))))));
}

function spheres() {
  const bytes = label => fit.find(one => one.label === label);
  return el('section', {}, el('h2', {}, 'A normal-mapped sphere'),
    el('p', {class: 'quiet'}, 'Each pixel has a lightmap of its own; bumps tilt normals by up to about 50 degrees. Below: bytes of a texel and the error '
      + 'over the sphere, of the truth’s root mean square.'),
    el('div', {class: 'maps'}, study.pictures.map((picture, i) => el('figure', {},
      el('figcaption', {}, picture.label + (i && bytes(picture.label) ? ` – ${bytes(picture.label).bytes} bytes, ${share(picture.rms)}` : '')),
      el('img', {src: picture.source, alt: `Sphere: ${picture.label}`, width: 176, height: 176, style: 'width: 100%; height: auto'})))));
}

function bytesSection() {
  const stage = el('div', {}, plotOfBytes());
  const change = value => { limit = Number(value); stage.replaceChildren(plotOfBytes()); };
  return el('section', {}, el('h2', {}, 'What a byte buys'),
    el('p', {class: 'quiet'}, 'The line joins what no smaller encoding beats. Point at a dot for its figures.'),
    el('div', {class: 'fields'}, select('normals tilted up to', study.tilt_limits.map((degrees, i) => [String(i), `${degrees}°`]), String(limit), change)), stage);
}

function tiltSection() {
  const shown = new Set(shownAtFirst), stage = el('div', {}, plotOfTilts(shown));
  const toggle = (label, on) => { shown[on ? 'add' : 'delete'](label); stage.replaceChildren(plotOfTilts(shown)); };
  return el('section', {}, el('h2', {}, 'By the tilt of the normal'),
    el('div', {class: 'fields'}, fit.map(one => el('label', {class: 'field'},
      el('input', {type: 'checkbox', checked: shown.has(one.label), onchange: event => toggle(one.label, event.target.checked)}), one.label))), stage);
}

const unfit = study.encodings.filter(one => one.unfit);
document.getElementById('main').append(bytesSection(), tiltSection(), ...(study.pictures.length ? [spheres()] : []),
  ...(study.probe ? [probeTable()] : []),
  el('section', {}, el('h2', {}, `All encodings, over ${thousands(study.lights)} lights`), table(),
    unfit.length ? el('ul', {class: 'remarks'}, unfit.map(one => el('li', {}, `${one.label}: ${one.unfit}`))) : ''));
document.documentElement.dataset.ready = 'yes';
