// Curves over the gait cycle with their bands, and over time.
const normal = (() => {
  const rows = data.normal_csv.split('\n').filter((line) => line && line[0] !== '#').map((line) => line.split(','));
  const head = rows.shift();
  return {percent: rows.map((r) => +r[0]), column: (name) => rows.map((r) => +r[head.indexOf(name)]),
    source: data.normal_csv.split('\n').filter((l) => l[0] === '#').map((l) => l.slice(2)).join(' ')};
})();

// Whom the range is of, as its source says: no adults.
const normalAges = 'healthy 4- to 17-year-olds';

// The published range at every per cent of the cycle.
function normalAt(name) {
  const column = normal.column(name);
  return Array.from({length: 101}, (_, i) => {
    const below = Math.min(normal.percent.length - 2, Math.floor(i / 2)), share = (i - normal.percent[below]) / 2;
    return column[below] + share * (column[below + 1] - column[below]);
  });
}

// What is drawn: caption, label of the axis, whether the normal range is comparable.
const angles = {
  hip_flexion: ['Hip', '°  extension − / flexion +', true], knee_flexion: ['Knee', '°  flexion +', true],
  ankle_dorsiflexion: ['Ankle', '°  plantar − / dorsiflexion +', true], pelvis_tilt: ['Pelvis', '°  forward tilt +', false],
};
const loads = {
  vertical_load: ['Vertical ground reaction', 'body weights'], hip_flexion_moment: ['Hip moment', 'N m/kg  extension − / flexion +'],
  knee_flexion_moment: ['Knee moment', 'N m/kg  extension − / flexion +'],
  ankle_dorsiflexion_moment: ['Ankle moment', 'N m/kg  plantar − / dorsiflexion +'],
};

// What video tells too badly to be read as numbers is drawn grey. Measured motions are as good as their measurement.
const rough = (name) => !analysed && (name.startsWith('ankle') || name in loads);
const roughAngles = 'Grey: ankle angles, and hip rotation in angles.csv, are rough estimates. Against motion capture the ankle is 8 to 23° off (rms), ' +
  'a large part of the 30° that an ankle moves in walking; outlines hardly show how a hip is rotated. Do not use them as measurements.';
const roughForces = 'Grey: forces, moments and work computed from video are rough estimates. Against force plates the vertical load is off by 14 % of body weight, ' +
  'and somebody assumed to stand still would be off by 15 %. Do not use them as measurements.';

function cycleChart(parent, cycles, name, [caption, label, comparable]) {
  const series = [{}], values = [Array.from({length: 101}, (_, i) => i)], bands = [];
  const line = (points, stroke, width) => {
    values.push(points);
    series.push({stroke, width, points: {show: false}});
  };
  const band = (low, high, fill) => {
    line(high, 'transparent', 0);
    line(low, 'transparent', 0);
    bands.push({series: [series.length - 2, series.length - 1], fill});
  };
  if (comparable) band(normalAt(name + '_low'), normalAt(name + '_high'), faded('#8b98a5', 0.3));
  const toeOffs = [];
  for (const {side, count, mean, p05, p95, strides} of cycles.filter((c) => c.name === name)) {
    if (!count) continue;
    for (const stride of strides) {
      if (count > 1) line(stride.values, faded(colours[side], 0.35), 1);
      if (stride.toe_off) toeOffs.push([100 * stride.toe_off, colours[side]]);
    }
    band(p05, p95, faded(colours[side], 0.18));
    line(mean, colours[side], 2.5);
  }
  const marks = (u) => {
    for (const [at, stroke] of toeOffs) {
      const x = u.valToPos(at, 'x', true);
      u.ctx.strokeStyle = faded(stroke, 0.6);
      u.ctx.setLineDash([4, 4]);
      u.ctx.beginPath(); u.ctx.moveTo(x, u.bbox.top); u.ctx.lineTo(x, u.bbox.top + u.bbox.height); u.ctx.stroke();
      u.ctx.setLineDash([]);
    }
  };
  chart(parent, caption, `${caption} over the gait cycle, left and right`, 230,
    {series, bands, scales: {x: {time: false, range: [0, 100]}}, hooks: {draw: [marks]},
      axes: [axis('% of the gait cycle', 24), axis(label, 40)]}, values,
    [rough(name) ? 'rough estimate' : '', comparable ? `grey band: ${normalAges}` : ''].filter(Boolean).join('; '), rough(name));
}

function cycleKey(strides, extra) {
  return element('p', {className: 'key'}, element('i', {className: 'left'}), `left, ${plural(strides('left'), 'stride')} `,
    element('i', {className: 'right'}), `right, ${plural(strides('right'), 'stride')} `, ...extra);
}

function startCycles() {
  const strides = (side) => Math.max(0, ...data.angles.filter((c) => c.side === side).map((c) => c.count));
  if (!strides('left') && !strides('right')) {
    byId('cycle-charts').append(element('p', {}, 'No whole stride, from one strike of a foot to its next, was tracked without a gap.'));
    return;
  }
  byId('cycle-charts').before(cycleKey(strides, [element('i', {className: 'normal'}), `${normalAges} (mean ± 1 SD)`]));
  for (const [name, what] of Object.entries(angles)) cycleChart(byId('cycle-charts'), data.angles, name, what);
  if (!analysed) byId('cycle-charts').after(element('p', {className: 'caution'}, roughAngles));
  byId('motion-range').append(table(['mean curve, °', 'least', 'greatest', 'range', 'greatest at %', 'at strike', `mean of ${normalAges}`], rangeRows()));
  byId('normal-note').textContent = `Bold: mean of the strides; thin: each stride; ${analysed ? '' : 'coloured band: 5–95 % of the filter’s particles; '}dashes: toe-off. ` +
    `${normal.source} The definitions differ (see the limits below): compare shape and range before level.`;
}

function rangeRows() {
  const rows = [];
  for (const [name, [caption, , comparable]] of Object.entries(angles)) {
    const normalMean = comparable ? normalAt(name + '_low').map((low, i) => (low + normalAt(name + '_high')[i]) / 2) : [];
    const typical = comparable ? `${fixed(Math.min(...normalMean), 0)} to ${fixed(Math.max(...normalMean), 0)}` : '–';
    for (const {side, count, mean} of data.angles.filter((c) => c.name === name)) {
      if (!count) continue;
      const low = Math.min(...mean), high = Math.max(...mean);
      rows.push([element('span', {className: rough(name) ? 'rough' : ''}, `${caption}, ${side}`), fixed(low, 1), fixed(high, 1), fixed(high - low, 1), fixed(mean.indexOf(high), 0), fixed(mean[0], 1), typical]);
    }
  }
  return rows;
}

function startForces() {
  const strides = (side) => Math.max(0, ...data.loads.filter((c) => c.side === side).map((c) => c.count));
  if (!strides('left') && !strides('right')) return;
  byId('forces').hidden = false;
  byId('force-charts').before(cycleKey(strides, []));
  for (const [name, what] of Object.entries(loads)) cycleChart(byId('force-charts'), data.loads, name, what);
  if (!analysed) byId('force-charts').after(element('p', {className: 'caution'}, roughForces));
  byId('force-totals').className = analysed ? '' : 'rough';
  const n = run.numbers;
  byId('force-totals').append(table(['whole walk', ''], [
    ['Way of the centre of mass, m', fixed(n.distance_m, 2)],
    ['Positive work of hips, knees and ankles, J', fixed(n.positive_work_j, 0)],
    ['Negative work, J', fixed(n.negative_work_j, 0)],
    ['Cost of transport (positive work per weight and way)', fixed(n.cost_of_transport, 3)],
    ['Greatest vertical load of a foot, body weights', fixed(n.peak_foot_load_body_weights, 2)],
  ]));
  byId('force-note').textContent = 'By inverse dynamics of the tracked body: computed from its motion, not measured. Moments are those of the muscles, ' +
    'positive as the angle is. In double support the sharing between the feet is a model; near the ends of the tracked span values lean on extrapolation. ' +
    `All scale with the mass of ${data.subject.mass_kg} kg.`;
}

function timeChart(caption, description, values, label, more = {}) {
  const lost = (u) => {
    u.ctx.fillStyle = '#00000012';
    data.joints.mean_mm.forEach((row, i) => {
      if (row) return;
      const from = u.valToPos(times[i] - 0.5 / data.rate, 'x', true), to = u.valToPos(times[i] + 0.5 / data.rate, 'x', true);
      u.ctx.fillRect(from, u.bbox.top, to - from, u.bbox.height);
    });
  };
  const now = (u) => {
    const x = u.valToPos(times[clock.frame] ?? 0, 'x', true);
    u.ctx.strokeStyle = '#0b5a8a'; u.ctx.lineWidth = 1;
    u.ctx.beginPath(); u.ctx.moveTo(x, u.bbox.top); u.ctx.lineTo(x, u.bbox.top + u.bbox.height); u.ctx.stroke();
  };
  const plot = chart(byId('time-charts'), caption, description, 130,
    {series: [{}, ...values.map(([, stroke, width = 1.5]) => ({stroke, width, points: {show: false}}))],
      scales: {x: {time: false, range: [times[0] ?? 0, Math.max(times[lastFrame] ?? 0, (times[0] ?? 0) + 0.1)]}, ...more.scales},
      hooks: {draw: [lost, now, ...(more.draw ?? [])]}, axes: [axis('s', 24), axis(label, 44)]},
    [times, ...values.map(([v]) => v)]);
  clock.listeners.push(() => plot.redraw(false));
  plot.over.addEventListener('click', (event) => clock.show(frameAt(plot.posToVal(event.offsetX, 'x'))));
}

// By camera: the share of figure and foreground that lie on each other.
function fitChart(series) {
  const shades = ['#0b5a8a', '#b06000', '#3f7f3f', '#8a3f8a', '#7a6a2f', '#5b6673'];
  const lines = Object.entries(series).filter(([name]) => name.startsWith('overlap_percent.'))
    .map(([name, values], i) => ({camera: name.slice('overlap_percent.'.length), values, shade: shades[i % shades.length]}));
  if (!lines.length) return;
  timeChart('How well the figure lies on the person', 'Overlap of figure and foreground over time, by camera',
    lines.map(({values, shade}) => [values, shade]), '%', {scales: {y: {range: [0, 100]}}});
  const caption = byId('time-charts').lastChild.querySelector('small');
  for (const {camera, shade} of lines) caption.append(element('i', {className: 'swatch', style: `background: ${shade}`}), `${camera} `);
}

// Bars of the feet on the ground.
function startTimes() {
  const series = run.by_frame;
  const contacts = (u) => {
    for (const contact of data.contacts) {
      const from = u.valToPos(contact.on, 'x', true), to = u.valToPos(contact.off, 'x', true);
      const top = u.valToPos(contact.side === 'left' ? 1.45 : 0.75, 'y', true), bottom = u.valToPos(contact.side === 'left' ? 1.05 : 0.35, 'y', true);
      u.ctx.fillStyle = faded(colours[contact.side], 0.8);
      u.ctx.fillRect(from, top, to - from, bottom - top);
    }
  };
  const none = times.map(() => null);
  timeChart('Feet on the ground', 'When each foot stood, left above right', [[none, colours.trunk]], 'right  left',
    {scales: {y: {range: [0.1, 1.7]}}, draw: [contacts]});
  if (analysed) return;
  fitChart(series);
  timeChart('Speed over the ground', 'Speed over time', [[series.speed, colours.trunk]], 'm/s');
  timeChart('Left foot carries the body: probability', 'Probability of left stance', [[series.left_stance, colours.left]], '', {scales: {y: {range: [-0.05, 1.05]}}});
  timeChart(`Effective number of particles (of ${run.config.filter.particles})`, 'Effective sample size over time',
    [[series.ess, colours.trunk], [times.map(() => run.config.filter.resample_below * run.config.filter.particles), '#b0b8c0', 1]], '', {scales: {y: {range: (u, min, max) => [0, max * 1.05]}}});
  const residuals = Object.keys(series).filter((name) => name.startsWith('keypoint_residual_px.'));
  if (residuals.length > 0) {
    const strokes = [colours.trunk, colours.left, colours.right];
    timeChart('Detected points to the reported pose, median of a frame', 'Distance of detected keypoints from the pose over time, a line for each camera',
      residuals.map((name, i) => [series[name], strokes[i % strokes.length]]), 'px');
  }
  timeChart('Log-evidence of the frame', 'Log-evidence over time', [[series.log_evidence, colours.trunk]], 'nats');
}
