// sections.js - the parts of the page, each a function that returns its section or null.

function section(id, heading, ...content) {
  return el('section', {id}, el('h2', {}, heading), content);
}

function facts() {
  const first = report.scene[0];
  const count = report.objects.length, cards = count ? [[String(count), count === 1 ? 'object' : 'objects']] : [];
  if (first) {
    cards.push([thousands(first.texels), 'texels']);
    const worst = report.scene.reduce((a, b) => Math.abs(b.relative_bias.value) > Math.abs(a.relative_bias.value) ? b : a);
    cards.push([signedPercent(worst.relative_bias.value), `largest bias (${worst.basis})`]);
    const rmse = report.scene.reduce((a, b) => b.relative_rmse.value > a.relative_rmse.value ? b : a);
    cards.push([percent(rmse.relative_rmse.value), `largest RMSE (${rmse.basis})`]);
  }
  const list = cards.map(([value, name]) => el('div', {class: 'fact'}, el('b', {}, value), el('span', {}, name)));
  if (report.thresholds.limits.length) list.push(verdict());
  return list;
}

function verdict() {
  const passed = report.thresholds.passed;
  const limits = report.thresholds.limits.map(one => `${one.metric} ${one.relative ? percent(one.limit) : number(one.limit)}`);
  return el('div', {class: 'fact'}, el('b', {class: passed ? 'good' : 'bad'}, passed ? 'within limits' : 'above limits'),
    el('span', {}, limits.join(', ')));
}

function sceneSection() {
  if (!report.scene.length) return null;
  const rows = report.scene.map(one => ({name: one.basis, statistic: one.relative_bias}));
  const errors = report.scene.map(one => ({name: one.basis, statistic: one.relative_rmse}));
  const noise = one => [one.noise.candidate, one.noise.reference].map(value => percent(known(value) ? relativeTo(value, one) : null)).join(' / ');
  return section('scene', 'Whole scene',
    el('p', {class: 'quiet'}, 'All objects as one, texel by texel, as shares of the reference\'s mean. ' + noiseSentence()),
    el('div', {class: 'charts'},
      el('figure', {}, el('figcaption', {}, 'bias with its 95 % interval'), intervalChart(rows, 'Bias for each basis', signedPercent)),
      el('figure', {}, el('figcaption', {}, 'RMSE with its 95 % interval'), intervalChart(errors, 'RMSE for each basis', percent))),
    el('div', {class: 'scroll'}, el('table', {class: 'numbers'},
      el('thead', {}, el('tr', {}, ['basis', 'reference mean', 'bias', 'RMSE', '95 %', '99 %', 'max', 'noise of either side']
        .map(name => el('th', {scope: 'col'}, name)))),
      el('tbody', {}, report.scene.map(one => el('tr', {}, el('th', {scope: 'row'}, one.basis),
        [number(one.reference_mean), `${signedPercent(one.relative_bias.value)} (${interval(one.relative_bias, signedPercent)})`,
          `${percent(one.relative_rmse.value)} (${interval(one.relative_rmse, percent)})`, percent(relativeTo(one.p95, one)),
          percent(relativeTo(one.p99, one)), percent(relativeTo(one.max.error, one)), noise(one)].map(text => el('td', {}, text))))))));
}

function noiseSentence() {
  const {candidate, reference} = report.scene[0].noise;
  if (known(candidate) && known(reference)) return 'The noise of both sides is taken out of bias and RMSE.';
  if (!known(candidate) && !known(reference)) return 'The noise of neither side is known: RMSE includes it.';
  return `The noise of ${known(candidate) ? report.reference : report.candidate} is not known: RMSE includes it.`;
}

function decompositionSection() {
  const all = report.decompositions;
  if (!all.length) return null;
  const stage = el('div');
  const show = index => stage.replaceChildren(decompositionOf(all[Number(index)]));
  show(0);
  return section('causes', 'What the error is made of',
    el('p', {class: 'quiet'}, 'Each cause switched off in turn. Bars to the right brighten, bars to the left darken; the line below a bar ' +
      'is its interval, the diamond the total. The residual is what no cause explains.'),
    all.length > 1 ? select('of', all.map((one, i) => [String(i), one.subject]), '0', show) : null, stage);
}

function decompositionOf(decomposition) {
  const names = [...new Set(decomposition.bases.flatMap(basis => basis.rows.map(row => row.name)))];
  const cell = (basis, row) => row
    ? el('td', {title: interval(row.relative_bias, signedPercent)}, signedPercent(row.relative_bias.value),
      el('small', {}, interval(row.relative_bias, signedPercent)),
      el('small', {}, `RMSE ${percent(row.relative_rmse.value)}`))
    : el('td', {}, '–');
  const swatch = name => {
    const mark = el('span', {class: 'swatch', 'aria-hidden': 'true'});
    mark.style.background = hues[names.indexOf(name) % hues.length];
    return mark;
  };
  const line = (name, mark, pick) => el('tr', {}, el('th', {scope: 'row'}, mark, name), decomposition.bases.map(basis => cell(basis, pick(basis))));
  return el('div', {}, stackedChart(decomposition.bases, names),
    el('div', {class: 'scroll'}, el('table', {class: 'numbers causes'},
      el('thead', {}, el('tr', {}, el('th', {scope: 'col'}, 'cause'), decomposition.bases.map(basis => el('th', {scope: 'col'}, basis.basis)))),
      el('tbody', {}, names.map(name => line(name, swatch(name), basis => basis.rows.find(row => row.name === name))),
        line('total', null, basis => basis.total)))));
}

function studySection() {
  if (!report.study.length) return null;
  const error = point => point.relative_rmse, time = point => ({value: point.seconds, low95: null, high95: null});
  return section('study', 'Error and time against the number of bake targets',
    el('div', {class: 'charts'},
      el('figure', {}, el('figcaption', {}, 'RMSE, share of the reference\'s mean'), studyChart(report.study, error, percent, 'Error against bake targets')),
      el('figure', {}, el('figcaption', {}, 'seconds'), studyChart(report.study, time, value => `${number(value)} s`, 'Time against bake targets'))),
    el('div', {class: 'scroll'}, el('table', {class: 'numbers'},
      el('thead', {}, el('tr', {}, ['split', 'targets', 'seconds', 'RMSE', 'interval'].map(name => el('th', {scope: 'col'}, name)))),
      el('tbody', {}, report.study.map(point => el('tr', {}, el('th', {scope: 'row'}, point.name),
        [point.targets, number(point.seconds), percent(point.relative_rmse.value), interval(point.relative_rmse, percent)]
          .map(text => el('td', {}, String(text)))))))));
}

function viewsSection() {
  const views = report.views.map((view, i) => ({view, entries: pictures.views[i]})).filter(one => one.entries.some(Boolean));
  return views.length ? section('views', 'Views', views.map(({view, entries}) => viewOf(view, entries))) : null;
}

function viewOf(view, entries) {
  const own = {exposure: 0, scale: look.scale}, stage = el('div', {class: 'quiet'}, 'Loading…');
  const size = picture => 'bytes' in picture ? `, ${picture.bytes} bytes a ${picture.bytes_of}` : '';
  const label = picture => picture.label + ('relative_rmse' in picture ? ` (RMSE ${percent(picture.relative_rmse)}${size(picture)})` : '');
  const show = async () => {
    const shown = view.pictures.map((picture, i) => ({picture, entry: entries[i]})).filter(one => one.entry);
    const layers = await Promise.all(shown.map(async one =>
      ({label: label(one.picture), kind: 'light', picture: (await unpack(one.entry)).picture})));
    const viewer = new Viewer(layers, {own, wide: true});
    stage.className = '';
    stage.replaceChildren(exposureField(own, value => { own.exposure = value; viewer.repaint(); }), viewer.element);
  };
  const near = new IntersectionObserver(seen => {
    if (!seen.some(one => one.isIntersecting)) return;
    near.disconnect();
    show().catch(problem => stage.replaceChildren(`The pictures cannot be shown: ${problem.message}.`));
  }, {rootMargin: '400px'});
  near.observe(stage);
  return el('div', {class: 'view'}, el('h3', {}, view.name), stage);
}

function objectsSection() {
  if (!report.objects.length) return null;
  const table = new ObjectTable();
  const search = el('input', {type: 'search', placeholder: 'part of a name', oninput: () => filter()});
  const only = el('input', {type: 'checkbox', onchange: () => filter()});
  const filter = () => table.filter(search.value, only.checked);
  const bases = [...new Set(report.objects.flatMap(object => object.bases.map(one => one.basis)))];
  filter();
  const tools = el('div', {class: 'fields tools'},
    el('label', {class: 'field'}, el('span', {}, 'find'), search),
    select('numbers of', [[worstBasis, 'each worst basis'], ...bases.map(name => [name, name])], worstBasis, basis => {
      table.basis = basis;
      table.fill();
      table.arrange();
    }),
    select('error scale', scales.map(scale => [String(scale), `± ${number(100 * scale)} %`]), String(look.scale), value => look.set('scale', Number(value))),
    exposureField(look, value => look.set('exposure', value)),
    report.thresholds.exceeded.length ? el('label', {class: 'field'}, only, el('span', {}, 'above a limit only')) : null,
    table.count);
  return section('objects', 'Objects',
    el('p', {class: 'quiet'}, 'Shares of the reference\'s mean of that object and basis. Open an object to see its maps.'), tools,
    el('div', {class: 'scroll sheet'}, el('table', {class: 'objects'}, el('thead', {}, el('tr', {}, table.heads)), table.body)), unmatched());
}

function unmatched() {
  const lists = [[report.candidate, report.candidate_only], [report.reference, report.reference_only]].filter(([, keys]) => keys.length);
  return lists.map(([label, keys]) => el('p', {class: 'remarks'}, `Only in ${label}: ${keys.join(', ')}`));
}

function settingsSection() {
  const list = pairs => el('dl', {class: 'pairs'}, pairs.flatMap(({key, value}) => [el('dt', {}, key), el('dd', {}, value)]));
  const copied = el('output', {class: 'quiet'});
  const copy = el('button', {type: 'button', onclick: async () => {
    try {
      await navigator.clipboard.writeText(report.command);
      copied.textContent = 'copied';
    } catch {
      copied.textContent = 'this browser does not let pages copy; select it by hand';
    }
  }}, 'copy');
  return section('settings', 'How this was made',
    report.notes.length ? el('ul', {class: 'remarks'}, report.notes.map(note => el('li', {}, note))) : null,
    report.command ? el('div', {class: 'command'}, el('pre', {}, el('code', {}, report.command)), copy, copied) : null,
    el('div', {class: 'charts'},
      report.settings.length ? el('div', {}, el('h3', {}, 'Settings'), list(report.settings)) : null,
      report.versions.length ? el('div', {}, el('h3', {}, 'Versions'), list(report.versions)) : null));
}
