// charts.js - intervals, bars, plots and histograms as SVG.

const hues = ['#3b6fb6', '#d98324', '#4f9d7a', '#a8518a', '#8a7f2c', '#5a5f73', '#c2503f', '#6fa8c9'];

// A round number for the end of an axis that holds `size`.
function roundUp(size) {
  if (!(size > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(size));
  return [1, 2, 5, 10].map(step => step * power).find(step => step >= size * 0.999999);
}

// The largest finite end of some intervals.
function reachOf(statistics) {
  const ends = statistics.flatMap(s => [s.value, s.low95, s.high95]).filter(known).map(Math.abs);
  return ends.length ? Math.max(...ends) : 0;
}

function title(text) {
  return svg('title', {}, text);
}

// A dot with its interval; `x` maps values to places.
function whisker(statistic, x, y, colour = 'currentColor') {
  const group = svg('g', {stroke: colour, fill: colour, class: 'whisker'});
  if (!known(statistic.value)) return group;
  if (known(statistic.low95)) {
    group.append(svg('line', {x1: x(statistic.low95), x2: x(statistic.high95), y1: y, y2: y, 'stroke-width': 1.6}));
    for (const end of [statistic.low95, statistic.high95])
      group.append(svg('line', {x1: x(end), x2: x(end), y1: y - 3, y2: y + 3, 'stroke-width': 1.6}));
  }
  group.append(svg('circle', {cx: x(statistic.value), cy: y, r: 3.2, stroke: 'none'}));
  return group;
}

// The small chart in a table's cell: 0 in the middle, `reach` at the ends.
function miniInterval(statistic, reach) {
  const width = 96, x = value => width / 2 + Math.min(Math.max(value / reach, -1.02), 1.02) * (width / 2 - 4);
  return svg('svg', {class: 'mini', viewBox: `0 0 ${width} 14`, 'aria-hidden': 'true'},
    svg('line', {x1: x(0), x2: x(0), y1: 0, y2: 14, class: 'zero'}), whisker(statistic, x, 7));
}

// An axis that holds all values and 0, with round numbers.
function axisOf(values) {
  const low = Math.min(0, ...values.filter(known)), high = Math.max(0, ...values.filter(known));
  const step = roundUp((high - low) / 5 || 1);
  const first = Math.floor(low / step + 1e-6), last = Math.max(Math.ceil(high / step - 1e-6), first + 1);
  return {low: first * step, high: last * step, ticks: Array.from({length: last - first + 1}, (_, i) => (first + i) * step)};
}

const endsOf = statistics => statistics.flatMap(s => [s.value, s.low95, s.high95]);

function grid(x, {ticks}, height, write) {
  return ticks.map(tick => svg('g', {class: tick === 0 ? 'zero' : 'grid'},
    svg('line', {x1: x(tick), x2: x(tick), y1: 6, y2: height}),
    svg('text', {x: x(tick), y: height + 15, 'text-anchor': 'middle'}, write(tick))));
}

// rows: [{name, statistic}]. One line each.
function intervalChart(rows, label, write) {
  const left = 70, width = 480, step = 26, height = rows.length * step + 10;
  const axis = axisOf(endsOf(rows.map(row => row.statistic)));
  const x = value => left + (value - axis.low) / (axis.high - axis.low) * (width - left - 24);
  return svg('svg', {class: 'chart', viewBox: `0 0 ${width} ${height + 22}`, role: 'img', 'aria-label': label},
    grid(x, axis, height, write),
    rows.map((row, i) => svg('g', {},
      title(`${row.name}: ${write(row.statistic.value)} (${interval(row.statistic, write)})`),
      svg('text', {x: left - 22, y: i * step + 24, 'text-anchor': 'end', class: 'name'}, row.name),
      whisker(row.statistic, x, i * step + 20))));
}

// bases: [{basis, rows: [{name, relative_bias}], total}]. Causes that brighten pile up to the right of 0, those that
// darken to the left; each end carries its cause's interval, the diamond is the total.
function stackedChart(bases, names) {
  const left = 70, width = 640, step = 46, height = bases.length * step + 6;
  const sums = bases.flatMap(basis => [-1, 1].map(side => basis.rows.reduce(
    (sum, row) => sum + side * Math.max(0, side * (row.relative_bias.value || 0)), 0)));
  const axis = axisOf([...sums, ...endsOf(bases.map(basis => basis.total.relative_bias))]);
  const x = value => left + (value - axis.low) / (axis.high - axis.low) * (width - left - 24);
  return svg('svg', {class: 'chart', viewBox: `0 0 ${width} ${height + 22}`, role: 'img',
    'aria-label': 'What the bias is made of, for each basis'}, grid(x, axis, height, signedPercent),
    bases.map((basis, i) => stack(basis, names, x, i * step + 12)));
}

function stack(basis, names, x, y) {
  const ends = {1: 0, '-1': 0};
  const group = svg('g', {}, svg('text', {x: 46, y: y + 17, 'text-anchor': 'end', class: 'name'}, basis.basis));
  for (const row of basis.rows) {
    const value = row.relative_bias.value || 0, side = value < 0 ? -1 : 1;
    const from = ends[side], to = from + value;
    ends[side] = to;
    const shifted = {value: to, low95: to + row.relative_bias.low95 - value, high95: to + row.relative_bias.high95 - value};
    group.append(svg('g', {},
      title(`${row.name}: ${signedPercent(value)} (${interval(row.relative_bias, signedPercent)})`),
      svg('rect', {x: Math.min(x(from), x(to)), y, width: Math.max(Math.abs(x(to) - x(from)), 0.5), height: 18,
        fill: hues[names.indexOf(row.name) % hues.length]}),
      known(row.relative_bias.low95)
        ? svg('line', {x1: x(shifted.low95), x2: x(shifted.high95), y1: y + 23, y2: y + 23, 'stroke-width': 2.5,
          stroke: hues[names.indexOf(row.name) % hues.length]}) : null));
  }
  const total = x(basis.total.relative_bias.value || 0);
  group.append(svg('path', {d: `M${total} ${y + 1}l8 8l-8 8l-8-8z`, class: 'total'},
    title(`total: ${signedPercent(basis.total.relative_bias.value)} (${interval(basis.total.relative_bias, signedPercent)})`)));
  return group;
}

// Targets along a logarithmic axis, one quantity upwards from 0.
function studyChart(points, value, write, label) {
  const left = 62, right = 20, width = 460, height = 230, bottom = 40;
  const targets = points.map(point => Math.max(point.targets, 1));
  const least = Math.log(Math.min(...targets)), most = Math.log(Math.max(...targets));
  const x = count => left + 18 + (most > least ? (Math.log(count) - least) / (most - least) : 0.5) * (width - left - right - 36);
  const top = axisOf(endsOf(points.map(value))).high;
  const y = share => height - bottom - share * (height - bottom - 14);
  const sorted = [...points].sort((a, b) => a.targets - b.targets);
  const place = point => `${x(Math.max(point.targets, 1))},${y((value(point).value || 0) / top)}`;
  return svg('svg', {class: 'chart', viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': label},
    [0, 0.5, 1].map(share => svg('g', {class: share ? 'grid' : 'zero'},
      svg('line', {x1: left, x2: width - right, y1: y(share), y2: y(share)}),
      svg('text', {x: left - 6, y: y(share) + 4, 'text-anchor': 'end'}, write(share * top)))),
    svg('polyline', {points: sorted.map(place).join(' '), class: 'path'}),
    sorted.map(point => {
      const statistic = value(point), at = x(Math.max(point.targets, 1));
      return svg('g', {class: 'point'}, title(`${point.name}: ${point.targets} targets, ${write(statistic.value)}`),
        known(statistic.low95) ? svg('line', {x1: at, x2: at, y1: y(statistic.low95 / top), y2: y(statistic.high95 / top)}) : null,
        svg('circle', {cx: at, cy: y((statistic.value || 0) / top), r: 4}),
        svg('text', {x: at, y: y(Math.max(statistic.value || 0, statistic.high95 || 0) / top) - 9, 'text-anchor': 'middle', class: 'name'}, point.name),
        svg('text', {x: at, y: height - bottom + 16, 'text-anchor': 'middle'}, String(point.targets)));
    }),
    svg('text', {x: (left + width - right) / 2, y: height - 6, 'text-anchor': 'middle'}, 'bake targets'));
}

// Counts of values in each of `bins` parts of [low, high]; values beyond count at the ends.
function binned(values, low, high, bins) {
  const counts = new Float64Array(bins);
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    counts[Math.min(bins - 1, Math.max(0, Math.floor((value - low) / (high - low) * bins)))] += 1;
  }
  return counts;
}

// Values of some series side by side: [{name, counts, fill}]; series after the first are drawn as outlines.
function histogram(series, ticks, label) {
  const width = 420, height = 130, base = 108, bins = series[0].counts.length;
  const top = Math.max(1, ...series.flatMap(one => [...one.counts]));
  const x = bin => 8 + bin / bins * (width - 16), y = count => base - count / top * 98;
  const shapes = series.map((one, k) => {
    let path = `M${x(0)} ${base}`;
    one.counts.forEach((count, bin) => { path += `V${y(count).toFixed(1)}H${x(bin + 1).toFixed(1)}`; });
    return svg('path', {d: `${path}V${base}`, class: k ? 'outline' : 'filled'}, title(one.name));
  });
  return svg('svg', {class: 'chart', viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': label}, shapes,
    svg('g', {class: 'zero'}, svg('line', {x1: 8, x2: width - 8, y1: base, y2: base})),
    ticks.map(([share, text]) => svg('g', {class: 'grid'},
      svg('text', {x: x(share * bins), y: base + 16, 'text-anchor': share < 0.05 ? 'start' : share > 0.95 ? 'end' : 'middle'}, text))));
}
