// viewer.js - pictures side by side with one pointer for all, and two of them under a slider.

const scales = [0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2];

// Display settings of all viewers. `changed` updates the open ones.
const look = {
  exposure: 0,
  scale: 0.1,
  viewers: new Set(),
  set(name, value) {
    this[name] = value;
    for (const viewer of [...this.viewers]) {
      if (viewer.element.isConnected) viewer.repaint();
      else this.viewers.delete(viewer);
    }
  },
};

function startLook() {
  const first = report.scene[0];
  if (!first || !(first.reference_mean > 0)) return;
  look.exposure = Math.round(2 * Math.log2(0.4 / first.reference_mean)) / 2;
  const spread = first.p95 / first.reference_mean;
  look.scale = scales.find(scale => scale >= spread) || scales[scales.length - 1];
}

// The printed scale under a map.
function legend(kind) {
  const gradient = el('span', {class: 'gradient', 'aria-hidden': 'true'});
  gradient.style.background = cssRamp(kind === 'signed' ? signedStops : noiseStops);
  const low = el('span'), middle = el('span'), high = el('span');
  const update = () => {
    low.textContent = kind === 'signed' ? signedPercent(-look.scale) : '0';
    middle.textContent = kind === 'signed' ? '0' : '';
    high.textContent = kind === 'signed' ? signedPercent(look.scale) : percent(look.scale);
  };
  return {element: el('div', {class: 'legend'}, gradient, el('div', {class: 'ends'}, low, middle, high)), update};
}

// layers: [{label, kind: 'light'|'signed'|'noise', picture}], all of one size. `full` is the width of the map before
// it was scaled down; `own` is a look of the viewer's own, else the page's; `beside` makes what stands by the slider.
class Viewer {
  constructor(layers, {full = 0, own = null, wide = false, beside = () => null} = {}) {
    Object.assign(this, {layers, full: full || layers[0].picture.width, look: own || look});
    this.width = layers[0].picture.width;
    this.height = layers[0].picture.height;
    this.cursor = null;
    this.readout = el('output', {class: 'readout'}, 'Point at a map, or focus it and use the arrow keys, to read its values.');
    this.panes = layers.map(layer => this.pane(layer));
    this.slider = new Slider(this);
    this.beside = beside;
    this.side = el('div', {class: 'beside'});
    this.element = el('div', {class: 'viewer' + (wide ? ' wide' : '')},
      el('div', {class: 'maps'}, this.panes.map(pane => pane.figure)), this.readout,
      el('div', {class: 'below'}, this.slider.element, this.side));
    look.viewers.add(this);
    this.repaint();
  }

  pane(layer) {
    const canvas = el('canvas', {tabindex: 0, role: 'img', 'aria-label': layer.label,
      onpointermove: event => this.point(event), onpointerdown: event => this.point(event),
      onkeydown: event => this.step(event)});
    const cross = el('span', {class: 'cross', hidden: true});
    const scale = layer.kind === 'light' ? null : legend(layer.kind);
    const figure = el('figure', {}, el('figcaption', {}, layer.label), el('div', {class: 'stage'}, canvas, cross),
      scale && scale.element);
    return {layer, canvas, cross, scale, figure};
  }

  repaint() {
    for (const pane of this.panes) {
      paint(pane.canvas, pane.layer, this.look);
      if (pane.scale) pane.scale.update();
    }
    this.slider.repaint();
    this.side.replaceChildren(this.beside() || '');
  }

  point(event) {
    const box = event.target.getBoundingClientRect();
    this.moveTo(Math.floor((event.clientX - box.left) / box.width * this.width),
      Math.floor((event.clientY - box.top) / box.height * this.height));
  }

  step(event) {
    const move = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
    if (!move) return;
    event.preventDefault();
    const from = this.cursor || {x: this.width >> 1, y: this.height >> 1};
    this.moveTo(from.x + move[0], from.y + move[1]);
  }

  moveTo(x, y) {
    this.cursor = {x: Math.min(Math.max(x, 0), this.width - 1), y: Math.min(Math.max(y, 0), this.height - 1)};
    for (const {cross} of this.panes) {
      cross.hidden = false;
      cross.style.left = `${(this.cursor.x + 0.5) / this.width * 100}%`;
      cross.style.top = `${(this.cursor.y + 0.5) / this.height * 100}%`;
    }
    this.read();
  }

  read() {
    const {x, y} = this.cursor, factor = Math.ceil(this.full / this.width);
    const place = factor > 1 ? `texels ${x * factor}–${(x + 1) * factor - 1}, ${y * factor}–${(y + 1) * factor - 1}` : `texel ${x}, ${y}`;
    this.readout.replaceChildren(el('b', {}, place), ...this.panes.map(({layer}) =>
      el('span', {}, el('i', {}, layer.label), ' ', this.valueOf(layer, y * this.width + x))));
  }

  valueOf(layer, texel) {
    const {data, channels} = layer.picture, values = [...data.slice(texel * channels, (texel + 1) * channels)];
    if (values.some(Number.isNaN)) return 'does not count';
    if (layer.kind === 'signed') return signedPercent(values[0]);
    return layer.kind === 'noise' ? percent(values[0]) : values.map(number).join('  ');
  }
}

// Two layers on top of each other; the handle uncovers one or the other.
class Slider {
  constructor(viewer) {
    this.viewer = viewer;
    this.shown = [0, Math.min(1, viewer.layers.length - 1)];
    this.canvases = [el('canvas', {class: 'over'}), el('canvas', {})];
    this.handle = el('span', {class: 'handle'});
    this.range = el('input', {type: 'range', min: 0, max: 1000, value: 500, 'aria-label': 'Where the two pictures meet',
      oninput: () => this.place()});
    const stage = el('div', {class: 'stage slide', onpointerdown: event => this.drag(event),
      onpointermove: event => event.buttons && this.drag(event)}, this.canvases[1], this.canvases[0], this.handle);
    stage.style.aspectRatio = `${viewer.width} / ${viewer.height}`;
    const choices = viewer.layers.map((layer, i) => [String(i), layer.label]);
    const chooser = (side, label) => select(label, choices, String(this.shown[side]), value => {
      this.shown[side] = Number(value);
      this.repaint();
    });
    this.element = el('details', {class: 'slider', open: true}, el('summary', {}, 'Slide between two'),
      el('div', {class: 'fields'}, chooser(0, 'left'), chooser(1, 'right')), stage, this.range);
    this.place();
  }

  repaint() {
    this.canvases.forEach((canvas, side) => paint(canvas, this.viewer.layers[this.shown[side]], this.viewer.look));
  }

  drag(event) {
    const box = event.currentTarget.getBoundingClientRect();
    this.range.value = Math.round(1000 * Math.min(Math.max((event.clientX - box.left) / box.width, 0), 1));
    this.place();
  }

  place() {
    const share = this.range.value / 10;
    this.canvases[0].style.clipPath = `inset(0 ${100 - share}% 0 0)`;
    this.handle.style.left = `${share}%`;
  }
}

function exposureField(target, changed) {
  const shown = el('output', {}, signed(target.exposure) + ' EV');
  const range = el('input', {type: 'range', min: -10, max: 10, step: 0.25, value: target.exposure, oninput: () => {
    shown.textContent = signed(Number(range.value)) + ' EV';
    changed(Number(range.value));
  }});
  return el('label', {class: 'field'}, el('span', {}, 'exposure'), range, shown);
}
