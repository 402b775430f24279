// format.js - numbers and elements as the page shows them. Text enters the page as text, never as markup.

// Three significant digits.
function number(value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const leading = Math.floor(Math.log10(Math.abs(value)));
  if (leading < -5 || leading > 6) return value.toExponential(2);
  return value.toFixed(Math.max(0, 2 - leading)).replace('-', '−');
}

function signed(value) {
  return (value > 0 ? '+' : '') + number(value);
}

const known = value => value !== null && value !== undefined && Number.isFinite(value);
const percent = value => known(value) ? hundredths(100 * value) + '\u00a0%' : '–';
const signedPercent = value => known(value) ? (value > 0 ? '+' : '') + hundredths(100 * value) + '\u00a0%' : '–';

// Two decimals, more where there would be nothing else, fewer from 10 on.
function hundredths(value) {
  const size = Math.abs(value);
  if (size >= 1000 || size === 0) return number(value);
  return value.toFixed(size >= 10 ? 1 : size >= 0.1 ? 2 : size >= 0.01 ? 3 : 4).replace('-', '−');
}

function interval(statistic, write) {
  if (!known(statistic.low95)) return 'interval unknown';
  return `${write(statistic.low95)} to ${write(statistic.high95)}`;
}

const thousands = value => String(value).replace(/\B(?=(\d{3})+$)/g, ' ');

// el('p', {class: 'x', onclick: f}, 'text', child, ...)
function el(tag, attributes = {}, ...children) {
  return dress(document.createElement(tag), attributes, children);
}

function svg(tag, attributes = {}, ...children) {
  return dress(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);
}

function dress(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children.flat(Infinity).filter(child => child !== null && child !== undefined));
  return element;
}

function select(label, options, chosen, change) {
  const list = el('select', {onchange: () => change(list.value)},
    options.map(([value, text]) => el('option', {value, selected: value === chosen}, text)));
  return el('label', {class: 'field'}, el('span', {}, label), list);
}
