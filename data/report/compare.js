// The page of a comparison: a table of parameters, curves and their differences, one side at a time.
const data = JSON.parse(document.getElementById('data').textContent);
const byStrides = data.method.unit === 'strides';
const shades = ['#5b6673', '#0b5a8a', '#b06000', '#3f7f3f', '#8a3f8a', '#7a6a2f'];
const oneGroup = data.groups.length === 1;
const shade = (sample, i) => oneGroup ? colours[sample.name] : shades[i % shades.length];
const sideWords = {both: 'Both sides', left: 'Left side', right: 'Right side'};
const percent = Array.from({length: 101}, (_, i) => i);

function spread(one, digits) {
  const made = element('span', {}, fixed(one.mean, digits));
  if (one.count) made.append(' ', element('small', {}, one.sd === null ? 'n = 1' : `± ${fixed(one.sd, digits)}, n = ${one.count}`));
  return made;
}

function difference(one, digits) {
  if (one.difference === undefined) return '–';
  const made = element('span', {}, (one.difference > 0 ? '+' : '') + fixed(one.difference, digits));
  if (one.low !== null) made.append(' ', element('small', {}, `${fixed(one.low, digits)} to ${fixed(one.high, digits)}`));
  return made;
}

const judged = (one) => one.detectable === undefined || one.detectable === null ? '–' : one.exceeds ? 'differs' : 'not told apart';

function parameterTable(reference, sample) {
  const made = table(['mean ± SD', reference.name, sample.name, `${sample.name} − ${reference.name}, 95 % interval`, 'detectable change', ''],
    data.parameters.map(({name, label, unit, digits}) => {
      const one = sample.parameters[name];
      return [`${label}, ${unit}`, spread(reference.parameters[name], digits), spread(one, digits), difference(one, digits),
        one.detectable === undefined ? '–' : fixed(one.detectable, digits), judged(one)];
    }), `parameters ${sample.name}`);
  made.classList.add('figures');
  for (const cell of made.querySelectorAll('td:last-child'))
    cell.className = cell.textContent === 'differs' ? 'bad' : '';
  return made;
}

const lineOf = (stroke, width) => ({stroke, width, points: {show: false}});

// Mean -/+ SD of every sample.
function meanChart(parent, {name, label}, samples) {
  const series = [{}], values = [percent], bands = [];
  samples.forEach((sample, i) => {
    const {mean, sd, count} = sample.angles[name];
    if (!count) return;
    if (count > 1) {
      for (const sign of [1, -1]) {
        values.push(mean.map((v, k) => v + sign * sd[k]));
        series.push(lineOf('transparent', 0));
      }
      bands.push({series: [series.length - 2, series.length - 1], fill: faded(shade(sample, i), 0.16)});
    }
    values.push(mean);
    series.push(lineOf(shade(sample, i), 2.5));
  });
  chart(parent, label, `${label} over the gait cycle of ${samples.map((s) => s.name).join(' and ')}`, 220,
    {series, bands, scales: {x: {time: false, range: [0, 100]}}, axes: [axis('% of the gait cycle', 24), axis('°', 40)]}, values, 'mean ± SD');
}

// The difference from the first sample with its band; shaded where the band leaves zero out.
function differenceChart(parent, {name, label}, samples) {
  const series = [{}], values = [percent], bands = [], apart = [];
  samples.slice(1).forEach((sample, i) => {
    const one = sample.angles[name];
    if (!one.difference) return;
    const stroke = oneGroup ? colours.trunk : shade(sample, i + 1);
    for (const edge of [one.high, one.low]) {
      values.push(edge);
      series.push(lineOf('transparent', 0));
    }
    bands.push({series: [series.length - 2, series.length - 1], fill: faded(stroke, 0.2)});
    values.push(one.difference);
    series.push(lineOf(stroke, 2));
    one.low.forEach((low, k) => { if (low !== null && (low > 0 || one.high[k] < 0)) apart.push([k, stroke]); });
  });
  const marks = (u) => {
    const {ctx} = u, zero = u.valToPos(0, 'y', true);
    ctx.strokeStyle = '#1c2530'; ctx.lineWidth = 1;
    ctx.beginPath(); ctx.moveTo(u.bbox.left, zero); ctx.lineTo(u.bbox.left + u.bbox.width, zero); ctx.stroke();
    const width = u.valToPos(1, 'x', true) - u.valToPos(0, 'x', true);
    for (const [k, fill] of apart) {
      ctx.fillStyle = fill;
      ctx.fillRect(u.valToPos(k, 'x', true) - width / 2, u.bbox.top + u.bbox.height - 6, width + 1, 6);
    }
  };
  const banded = samples.slice(1).some((sample) => sample.angles[name].low?.[0] !== null && sample.angles[name].low);
  const reach = (u, low, high) => { const most = 1.05 * Math.max(Math.abs(low ?? 0), Math.abs(high ?? 0), 1); return [-most, most]; };
  chart(parent, `${label}, difference`, `Difference of ${label} from ${samples[0].name}`, 180,
    {series, bands, hooks: {draw: [marks]}, scales: {x: {time: false, range: [0, 100]}, y: {range: reach}},
      axes: [axis('% of the gait cycle', 24), axis('°', 40)]}, values,
    banded ? '95 % band of the whole curve; bar: zero lies outside' : `no band: fewer than three ${data.method.unit}`);
}

function show({side, samples}) {
  const [reference, ...others] = samples;
  byId('parameter-tables').replaceChildren(...others.map((sample) => parameterTable(reference, sample)));
  byId('curve-key').replaceChildren(...samples.flatMap((sample, i) =>
    [element('i', {style: `background: ${shade(sample, i)}`}), `${sample.name}, ${plural(sample.angles[data.angles[0].name].count, data.method.unit.slice(0, -1))} `]));
  byId('curve-charts').replaceChildren();
  for (const angle of data.angles) {
    const pair = element('div', {});
    byId('curve-charts').append(pair);
    meanChart(pair, angle, samples);
    differenceChart(pair, angle, samples);
  }
  for (const button of byId('sides').children) button.ariaPressed = String(button.value === side);
}

function verdict() {
  const counted = data.comparisons[0].samples.slice(1).flatMap((sample) => Object.values(sample.parameters)).filter((one) => typeof one.detectable === 'number');
  const exceeding = counted.filter((one) => one.exceeds).length;
  byId('title').textContent = data.title;
  byId('verdict').textContent = counted.length
    ? `${exceeding} of ${plural(counted.length, 'difference')} exceed${exceeding === 1 ? 's' : ''} the minimal detectable change`
    : 'Too few strides to tell differences from chance';
  for (const sample of data.comparisons[0].samples) {
    const group = oneGroup ? data.groups[0] : data.groups.find(({name}) => name === sample.name);
    const strides = group.trials.reduce((sum, {strides}) => sum + (oneGroup ? strides[sample.name] : strides.left + strides.right), 0);
    byId('key-figures').append(element('li', {}, element('b', {}, `${strides}`, ' ', element('small', {}, strides === 1 ? 'stride' : 'strides')),
      element('span', {}, `${sample.name}, ${plural(group.trials.length, 'recording')}`)));
  }
}

function words() {
  const {unit, draws, seed} = data.method;
  const banded = data.comparisons[0].samples.slice(1).every((sample) => Object.values(sample.parameters).every((one) => one.with_bands !== false));
  byId('method').textContent = `Intervals and bands: 95 %, bootstrap over ${unit} (bootstrap-t, ${draws} draws, seed ${seed}); the band of a curve holds for the whole curve at once ` +
    '(greatest deviation over the cycle). With few strides the bands are too wide rather than too narrow; groups of fewer than three strides have no bands.';
  byId('parameter-note').textContent = `Detectable change: 1.96 √(SEM² + SEM²), with the value of Student’s t instead of 1.96 for few ${unit}. The SEM of a group is its scatter over ${unit}` +
    (banded ? ' together with the uncertainty of the tracker. ' : '; results without bands add no uncertainty of the measurement to it. ') +
    '“Not told apart” does not mean “the same”. ' + (byStrides && data.groups.some(({trials}) => trials.length > 1)
      ? 'The strides of all recordings of a group have the same weight: if the recordings are of several people or days, compare with --unit trials.' : '');
  byId('curve-note').textContent = 'A cycle goes from one heel strike to the next heel strike of the same foot. ' +
    'Ankle angles of a video are rough: many strides are needed to see differences between them.';
  byId('trial-table').append(table(['group', 'recording', 'strides left', 'strides right', 'quality'],
    data.groups.flatMap(({name, trials}) => trials.map((t) => [name, t.folder, `${t.strides.left}`, `${t.strides.right}`,
      t.failed_checks.length ? `failed: ${t.failed_checks.join('; ')}` : t.status])), 'recordings'));
  byId('colophon').textContent = `Made by walktrack ${data.program}. The same numbers: compare.json, compare_parameters.csv, compare_curves.csv. Drawn with uPlot, which is inside this page.`;
}

verdict();
words();
if (data.comparisons.length > 1) {
  for (const comparison of data.comparisons)
    byId('sides').append(element('button', {type: 'button', value: comparison.side, onclick: () => show(comparison)}, sideWords[comparison.side]));
}
show(data.comparisons[0]);
document.documentElement.dataset.ready = 'true';
