// objects.js - the table of objects, and what opens under a row.

const worstBasis = '';  // the choice "worst basis"

// Basis in an object's row: the chosen one, or the one with the largest relative RMSE.
function metricsOf(object, basis) {
  if (basis !== worstBasis) return object.bases.find(one => one.basis === basis) || null;
  const size = one => known(one.relative_rmse.value) ? one.relative_rmse.value : -1;
  return object.bases.reduce((worst, one) => !worst || size(one) > size(worst) ? one : worst, null);
}

const relativeTo = (value, metrics) => metrics.reference_mean > 0 ? value / metrics.reference_mean : null;

// key: what a row is sorted by, given the object, its metrics and its row.
const columns = [
  {name: 'object', key: row => row.object.key.toLowerCase(), text: true},
  {name: 'basis', key: row => row.metrics ? row.metrics.basis : '', text: true, minor: true},
  {name: 'texels', key: row => row.metrics ? row.metrics.texels : 0, minor: true},
  {name: 'bias', key: row => row.metrics && Math.abs(row.metrics.relative_bias.value)},
  {name: 'RMSE', key: row => row.metrics && row.metrics.relative_rmse.value},
  {name: '95 %', key: row => row.metrics && relativeTo(row.metrics.p95, row.metrics), minor: true,
    hint: '95 of 100 texels err less, noise included'},
  {name: '99 %', key: row => row.metrics && relativeTo(row.metrics.p99, row.metrics), minor: true,
    hint: '99 of 100 texels err less, noise included'},
  {name: 'max', key: row => row.metrics && relativeTo(row.metrics.max.error, row.metrics), minor: true,
    hint: 'the worst texel, noise included'},
  {name: 'sound', key: row => row.object.validity, minor: true, hint: 'share of the texels that see no back face'},
];

class ObjectTable {
  constructor() {
    this.basis = worstBasis;
    this.sorted = {column: columns[4], down: true};
    this.exceeded = new Set(report.thresholds.exceeded.map(one => one.object));
    this.body = el('tbody');
    this.count = el('output', {class: 'count', 'aria-live': 'polite'});
    this.rows = report.objects.map((object, index) => this.row(object, index));
    this.heads = columns.map(column => this.head(column));
    this.thumbs = new IntersectionObserver(seen => this.drawThumbs(seen), {rootMargin: '300px'});
    this.fill();
    this.arrange();
    for (const row of this.rows) this.thumbs.observe(row.thumbs);
  }

  head(column) {
    const button = el('button', {type: 'button', title: column.hint || null, onclick: () => this.sortBy(column)}, column.name);
    return el('th', {scope: 'col', class: (column.minor ? 'minor ' : '') + (column.text ? 'text' : ''), 'aria-sort': 'none'}, button);
  }

  row(object, index) {
    const row = {object, index, metrics: null, cells: columns.slice(1).map(column =>
      el('td', {class: (column.minor ? 'minor ' : '') + (column.text ? 'text' : '')}))};
    row.thumbs = el('span', {class: 'thumbs', 'aria-hidden': 'true'});
    row.button = el('button', {type: 'button', class: 'open', 'aria-expanded': 'false', onclick: () => this.toggle(row)},
      row.thumbs, el('span', {class: 'key'}, object.key,
        this.exceeded.has(object.key) ? el('span', {class: 'badge bad'}, 'above limit') : null));
    row.element = el('tr', {}, el('th', {scope: 'row'}, row.button), row.cells);
    return row;
  }

  // Writes the numbers for the basis chosen.
  fill() {
    for (const row of this.rows) row.metrics = metricsOf(row.object, this.basis);
    const reach = roundUp(reachOf(this.rows.filter(row => row.metrics).map(row => row.metrics.relative_bias)));
    for (const row of this.rows) this.fillRow(row, reach);
  }

  fillRow({object, metrics, cells}, reach) {
    if (!metrics) return cells.forEach(cell => cell.replaceChildren('–'));
    const [basis, texels, bias, rmse, p95, p99, max, sound] = cells;
    basis.replaceChildren(metrics.basis);
    texels.replaceChildren(thousands(metrics.texels));
    bias.replaceChildren(el('span', {title: interval(metrics.relative_bias, signedPercent)}, signedPercent(metrics.relative_bias.value)),
      ...(metrics.too_noisy ? [el('span', {class: 'badge'}, 'too noisy to tell')] : []),
      miniInterval(metrics.relative_bias, reach));
    rmse.replaceChildren(el('span', {title: interval(metrics.relative_rmse, percent)}, percent(metrics.relative_rmse.value)));
    p95.replaceChildren(percent(relativeTo(metrics.p95, metrics)));
    p99.replaceChildren(percent(relativeTo(metrics.p99, metrics)));
    max.replaceChildren(percent(relativeTo(metrics.max.error, metrics)));
    sound.replaceChildren(known(object.validity) ? percent(object.validity) : '–');
  }

  sortBy(column) {
    const down = this.sorted.column === column ? !this.sorted.down : !column.text;
    this.sorted = {column, down};
    this.arrange();
  }

  // Unknown values stand last either way; equal ones keep the scene's order.
  arrange() {
    const {column, down} = this.sorted;
    const missing = value => value === null || value === undefined || Number.isNaN(value);
    const order = [...this.rows].sort((a, b) => {
      const x = column.key(a), y = column.key(b);
      if (missing(x) || missing(y)) return missing(x) - missing(y) || a.index - b.index;
      return (x < y ? -1 : x > y ? 1 : 0) * (down ? -1 : 1) || a.index - b.index;
    });
    this.body.replaceChildren(...order.flatMap(row => row.detail ? [row.element, row.detail] : [row.element]));
    columns.forEach((one, i) => this.heads[i].setAttribute('aria-sort', one !== column ? 'none' : down ? 'descending' : 'ascending'));
  }

  filter(text, onlyExceeded) {
    const wanted = text.trim().toLowerCase();
    let shown = 0;
    for (const row of this.rows) {
      const fits = row.object.key.toLowerCase().includes(wanted) && (!onlyExceeded || this.exceeded.has(row.object.key));
      row.element.hidden = !fits;
      if (row.detail) row.detail.hidden = !fits;
      shown += fits ? 1 : 0;
    }
    this.count.textContent = shown === this.rows.length ? `${shown} objects` : `${shown} of ${this.rows.length} objects`;
  }

  async drawThumbs(seen) {
    for (const {isIntersecting, target} of seen) {
      const row = isIntersecting && this.rows.find(one => one.thumbs === target);
      if (!row) continue;
      this.thumbs.unobserve(target);
      const maps = pictures.objects[row.index][0];
      const found = maps ? await layersOf(row.object, maps).catch(() => []) : [];
      const layers = found.filter(layer => layer.thumb);
      for (const layer of layers) {
        const canvas = el('canvas', {});
        paint(canvas, layer, look);
        target.append(canvas);
      }
    }
  }

  toggle(row) {
    const open = !row.detail;
    row.button.setAttribute('aria-expanded', String(open));
    if (!open) {
      row.detail.remove();
      row.detail = null;
      return;
    }
    row.detail = el('tr', {class: 'detail'}, el('td', {colspan: columns.length}, objectDetail(row.object, row.index)));
    row.element.after(row.detail);
  }
}

// The maps of one basis as layers.
async function layersOf(object, maps) {
  const metrics = object.bases.find(one => one.basis === maps.basis);
  const found = await unpack(maps);
  const mean = metrics && metrics.reference_mean > 0 ? metrics.reference_mean : 1;
  const layers = [
    {label: report.candidate, kind: 'light', picture: found.candidate, thumb: true},
    {label: report.reference, kind: 'light', picture: found.reference},
    {label: 'relative error', kind: 'signed', picture: relativeError(found.candidate, found.reference, mean), thumb: true},
  ];
  for (const [name, label] of [['candidate_noise', report.candidate], ['reference_noise', report.reference]])
    if (found[name]) layers.push({label: `standard error, ${label}`, kind: 'noise', picture: scaledBy(found[name], 1 / mean)});
  return layers;
}

function histograms(layers) {
  const error = layers.find(layer => layer.kind === 'signed').picture.data;
  const light = layers.filter(layer => layer.kind === 'light').map(({label, picture}) =>
    ({label, values: Float32Array.from({length: picture.width * picture.height}, (_, i) => Math.log2(meanAt(picture, i)))}));
  const finite = light.flatMap(one => [...one.values]).filter(Number.isFinite).sort((a, b) => a - b);
  const low = Math.floor(finite[Math.floor(finite.length * 0.005)] || 0), high = Math.max(Math.ceil(finite[finite.length - 1] || 1), low + 1);
  const stops = share => number(2 ** (low + share * (high - low)));
  return el('div', {},
    el('figure', {}, el('figcaption', {}, 'relative error of the texels'),
      histogram([{name: 'texels', counts: binned(error, -look.scale, look.scale, 60)}],
        [[0, signedPercent(-look.scale)], [0.5, '0'], [1, signedPercent(look.scale)]], 'Histogram of the relative error')),
    el('figure', {}, el('figcaption', {}, `E/π of the texels: ${light[0].label} filled, ${light[1].label} outlined`),
      histogram(light.map(one => ({name: one.label, counts: binned(one.values, low, high, 60)})),
        [[0, stops(0)], [0.5, stops(0.5)], [1, stops(1)]], 'Histogram of the values')));
}

function basisTable(object) {
  const head = ['basis', 'bias', 'interval', 'RMSE', 'interval', '95 %', '99 %', 'max', 'at'];
  return el('div', {class: 'scroll'}, el('table', {class: 'numbers'},
    el('thead', {}, el('tr', {}, head.map(name => el('th', {scope: 'col'}, name)))),
    el('tbody', {}, object.bases.map(one => el('tr', {}, el('th', {scope: 'row'}, one.basis),
      [signedPercent(one.relative_bias.value) + (one.too_noisy ? ', too noisy to tell' : ''), interval(one.relative_bias, signedPercent), percent(one.relative_rmse.value),
        interval(one.relative_rmse, percent), percent(relativeTo(one.p95, one)), percent(relativeTo(one.p99, one)),
        percent(relativeTo(one.max.error, one)), `${one.max.x}, ${one.max.y}`].map(text => el('td', {}, text)))))));
}

function remarks(object) {
  const lines = object.outside_model.map(text => `outside the reference's model: ${text}`).concat(object.notes);
  const lost = Math.max(0, ...object.bases.map(one => one.non_finite));
  if (lost) lines.push(`${lost} texels are not finite and do not count`);
  return lines.length ? el('ul', {class: 'remarks'}, lines.map(line => el('li', {}, line))) : null;
}

// Details under a row, built when the user opens it.
function objectDetail(object, index) {
  const maps = pictures.objects[index], stage = el('div', {class: 'stage-of-basis'});
  const show = async basis => {
    const entry = maps.find(one => one.basis === basis);
    const layers = await layersOf(object, entry);
    const viewer = new Viewer(layers, {full: object.width, beside: () => histograms(layers)});
    const metrics = object.bases.find(one => one.basis === basis);
    const factor = Math.ceil(object.width / viewer.width);
    const worst = el('button', {type: 'button', onclick: () => viewer.moveTo(Math.floor(metrics.max.x / factor), Math.floor(metrics.max.y / factor))},
      `worst texel (${metrics.max.x}, ${metrics.max.y})`);
    const size = `${object.width} × ${object.height} texels` + (factor > 1 ? `, shown as means of ${factor} × ${factor}` : '');
    stage.replaceChildren(el('p', {class: 'fields'}, el('span', {class: 'quiet'}, size), metrics.texels ? worst : null), viewer.element);
  };
  if (maps.length) show(maps[0].basis).catch(problem => stage.replaceChildren(
    el('p', {class: 'warning'}, `The maps cannot be shown: ${problem.message}. A browser of 2023 or newer can.`)));
  return el('div', {class: 'object'}, remarks(object), basisTable(object),
    maps.length > 1 ? select('maps of basis', maps.map(one => [one.basis, one.basis]), maps[0].basis, show) : null,
    maps.length ? stage : el('p', {class: 'quiet'}, 'No maps were kept of this object.'),
    el('p', {class: 'quiet files'}, `${report.candidate}: ${object.candidate_files.join(', ')} · ${report.reference}: ${object.reference_files.join(', ')}`));
}
