// Curves over the gait cycle with their bands, and over time.
// Norms: comments (#) say of whom (who: ...) and from where, a header names percent,<angle>_low,<angle>_high,... Throws
// an Error that says what is wrong.
function readNorms(text, name) {
  const lines = text.split(/\r?\n/), notes = lines.filter((line) => line[0] === '#').map((line) => line.slice(1).trim());
  const rows = lines.filter((line) => line.trim() && line[0] !== '#').map((line) => line.split(',').map((cell) => cell.trim()));
  const head = rows.shift() ?? [], at = Object.fromEntries(head.map((column, i) => [column, i]));
  if (head[0] !== 'percent') throw new Error(`${name}: the header has to begin with percent, and it begins with '${head[0] ?? ''}'`);
  const numbers = rows.map((row) => row.map((cell) => cell === '' ? NaN : Number(cell)));
  const wrong = numbers.findIndex((row, i) => row.length !== head.length || row.some((value) => !isFinite(value)) ||
    row[0] < 0 || row[0] > 100 || (i > 0 && row[0] <= numbers[i - 1][0]));
  if (wrong >= 0) throw new Error(`${name}: row ${wrong + 1} below the header is not a row of numbers with a percent that grows from 0 to 100`);
  if (numbers.length < 2) throw new Error(`${name}: there are fewer than two rows`);
  const told = notes.find((note) => note.startsWith('who:'));
  return {who: told ? told.slice(4).trim() : name.replace(/\.csv$/i, ''), source: notes.filter((note) => note !== told).join(' '), percent: numbers.map((row) => row[0]),
    has: (angle) => angle + '_low' in at && angle + '_high' in at, column: (column) => numbers.map((row) => row[at[column]])};
}

const shippedNorms = readNorms(data.normal_csv, 'normal_gait.csv');
const allNorms = [shippedNorms];
let norms = shippedNorms;

// The norm at every per cent of the cycle, null outside it.
function normalAt(name) {
  const {percent} = norms, column = norms.column(name);
  return Array.from({length: 101}, (_, at) => {
    const after = percent.findIndex((p) => p >= at);
    if (after < 0 || (after === 0 && percent[0] > at)) return null;
    if (percent[after] === at) return column[after];
    const share = (at - percent[after - 1]) / (percent[after] - percent[after - 1]);
    return (1 - share) * column[after - 1] + share * column[after];
  });
}

// The shipped range has other axes of the pelvis; whose own norms they are knows theirs.
const comparable = (name) => norms.has(name) && (norms !== shippedNorms || !(name in angles) || angles[name][2]);

// What is drawn: caption, label of the axis, whether the shipped norms are comparable.
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
const rough = (name) => !analysed && (name.startsWith('ankle') || name === 'hip_rotation' || name in loads);
const roughAngles = 'Grey: ankle angles and hip rotation are rough estimates. Against motion capture the ankle is 7 to 28° off (rms), ' +
  'a large part of the 30° that an ankle moves in walking; outlines hardly show how a hip is rotated. Do not use them as measurements.';
const roughForces = 'Grey: forces, moments and work computed from video are rough estimates. Against force plates the vertical load is off by 7 to 12 % of body weight, ' +
  'and somebody assumed to stand still would be off by 16 to 17 %. Do not use them as measurements.';

function cycleChart(parent, cycles, name, [caption, label]) {
  const series = [{}], values = [Array.from({length: 101}, (_, i) => i)], bands = [], columns = ['percent'];
  const line = (points, stroke, width, name) => {
    values.push(points);
    columns.push(name);
    series.push({stroke, width, points: {show: false}});
  };
  const band = (low, high, fill, names) => {
    line(high, 'transparent', 0, names[1]);
    line(low, 'transparent', 0, names[0]);
    bands.push({series: [series.length - 2, series.length - 1], fill});
  };
  if (comparable(name)) band(normalAt(name + '_low'), normalAt(name + '_high'), faded('#8b98a5', 0.3), ['norm low', 'norm high']);
  const toeOffs = [];
  for (const {side, count, mean, p05, p95, strides} of cycles.filter((c) => c.name === name)) {
    if (!count) continue;
    for (const [i, stride] of strides.entries()) {
      if (count > 1) line(stride.values, faded(colours[side], 0.35), 1, `${side} stride ${i + 1}`);
      if (stride.toe_off) toeOffs.push([100 * stride.toe_off, colours[side]]);
    }
    band(p05, p95, faded(colours[side], 0.18), [`${side} p05`, `${side} p95`]);
    line(mean, colours[side], 2.5, `${side} mean`);
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
    [rough(name) ? 'rough estimate' : '', comparable(name) ? `grey band: ${norms.who}` : ''].filter(Boolean).join('; '), rough(name), columns);
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
  startNorms();
  drawCycles();
}

function drawCycles() {
  const strides = (side) => Math.max(0, ...data.angles.filter((c) => c.side === side).map((c) => c.count));
  byId('cycle-key').replaceChildren(cycleKey(strides, [element('i', {className: 'normal'}), `${norms.who}${norms === shippedNorms ? ' (mean ± 1 SD)' : ''}`]));
  byId('cycle-charts').replaceChildren();
  for (const [name, what] of Object.entries(angles)) cycleChart(byId('cycle-charts'), data.angles, name, what);
  byId('cycle-caution').replaceChildren(...analysed ? [] : [element('p', {className: 'caution'}, roughAngles)]);
  byId('motion-range').replaceChildren(table(['mean curve, °', 'least', 'greatest', 'range', 'greatest at %', 'at strike', `mean of ${norms.who}`], rangeRows(), 'angle ranges'));
  byId('normal-note').textContent = `Bold lines: mean of the strides; thin lines: each stride; ${analysed ? '' : 'coloured bands: 5–95 %, of each stride; '}dashed lines: toe-off. ` +
    `${norms.source} ${norms === shippedNorms ? 'Its angles are defined differently (see the limits below): compare shape and range before the level.' : ''}`;
}

// The reader's own norms, from files that the browser reads and nobody else.
function startNorms() {
  const choice = byId('norm-choice'), files = byId('norm-files');
  const list = () => choice.replaceChildren(...allNorms.map((each, i) => element('option', {value: i, selected: each === norms}, each.who)));
  const draw = () => {
    drawCycles();
    byId('more-charts').replaceChildren();
    if (byId('more-angles').open) drawMoreAngles();
  };
  choice.onchange = () => { norms = allNorms[Number(choice.value)]; draw(); };
  files.onchange = async () => {
    const wrong = [];
    for (const file of [...files.files].sort((a, b) => a.name < b.name ? -1 : 1)) {
      try {
        allNorms.push(readNorms(await file.text(), file.name));
        norms = allNorms.at(-1);
      } catch (error) { wrong.push(error.message); }
    }
    byId('norm-message').textContent = wrong.join('; ');
    list();
    draw();
  };
  byId('norms').hidden = false;
  list();
}

function rangeRows() {
  const rows = [];
  for (const [name, [caption]] of Object.entries(angles)) {
    const high = comparable(name) ? normalAt(name + '_high') : [];
    const normalMean = comparable(name) ? normalAt(name + '_low').map((low, i) => low === null ? null : (low + high[i]) / 2).filter((value) => value !== null) : [];
    const typical = comparable(name) ? `${fixed(Math.min(...normalMean), 0)} to ${fixed(Math.max(...normalMean), 0)}` : '–';
    for (const {side, count, mean} of data.angles.filter((c) => c.name === name)) {
      if (!count) continue;
      const low = Math.min(...mean), high = Math.max(...mean);
      rows.push([element('span', {className: rough(name) ? 'rough' : ''}, `${caption}, ${side}`), fixed(low, 1), fixed(high, 1), fixed(high - low, 1), fixed(mean.indexOf(high), 0), fixed(mean[0], 1), typical]);
    }
  }
  return rows;
}

// What angles.csv has besides, drawn when it is asked for.
const moreAngles = {
  hip_adduction: ['Hip adduction', '°  out − / in +'], hip_rotation: ['Hip rotation', '°  toes out − / in +'],
  pelvis_list: ['Pelvis obliquity', '°  left down − / right down +'], pelvis_rotation: ['Pelvis rotation', '°  from x, to the left +'],
  lumbar_extension: ['Trunk against pelvis, forward', '°  backward − / forward +'], lumbar_bending: ['Trunk against pelvis, sideways', '°  left − / right +'],
  lumbar_rotation: ['Trunk against pelvis, turn', '°  right − / left +'], trunk_tilt: ['Trunk', '°  backward − / forward +'],
};

function startMoreAngles() {
  const more = byId('more-angles');
  more.hidden = !data.more_angles.some((c) => c.count);
  more.addEventListener('toggle', () => { if (!byId('more-charts').children.length) drawMoreAngles(); });
}

function drawMoreAngles() {
  for (const [name, what] of Object.entries(moreAngles)) cycleChart(byId('more-charts'), data.more_angles, name, what);
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
    ['Path of the centre of mass, m', fixed(n.distance_m, 2)],
    ['Positive work of hips, knees and ankles, J', fixed(n.positive_work_j, 0)],
    ['Negative work, J', fixed(n.negative_work_j, 0)],
    ['Cost of transport (positive work divided by weight and path)', fixed(n.cost_of_transport, 3)],
    ['Greatest vertical load of a foot, body weights', fixed(n.peak_foot_load_body_weights, 2)],
  ], 'forces of the whole walk'));
  byId('force-note').textContent = 'The forces are computed from the motion by inverse dynamics of the tracked body, not measured. Moments are those of the muscles, ' +
    'with the signs of the angles. In double support the division between the feet is a model; near the ends of the tracked frames the values depend on extrapolation. ' +
    `All values are proportional to the mass of ${data.subject.mass_kg} kg.`;
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
    [times, ...values.map(([v]) => v)], '', false, ['t', ...values.map(([v, , , name]) => v.some((x) => x !== null) ? name ?? caption : '')]);
  clock.listeners.push(() => plot.redraw(false));
  plot.over.addEventListener('click', (event) => clock.show(frameAt(plot.posToVal(event.offsetX, 'x'))));
}

// By camera: the share of figure and foreground that lie on each other.
function fitChart(series) {
  const shades = ['#0b5a8a', '#b06000', '#3f7f3f', '#8a3f8a', '#7a6a2f', '#5b6673'];
  const lines = Object.entries(series).filter(([name]) => name.startsWith('overlap_percent.'))
    .map(([name, values], i) => ({camera: name.slice('overlap_percent.'.length), values, shade: shades[i % shades.length]}));
  if (!lines.length) return;
  timeChart('Overlap of the figure with the foreground', 'Overlap of figure and foreground over time, by camera',
    lines.map(({camera, values, shade}) => [values, shade, 1.5, camera]), '%', {scales: {y: {range: [0, 100]}}});
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
  timeChart('Feet on the ground', 'Times at which each foot was on the ground, left above right', [[none, colours.trunk]], 'right  left',
    {scales: {y: {range: [0.1, 1.7]}}, draw: [contacts]});
  if (analysed) return;
  fitChart(series);
  timeChart('Speed over the ground', 'Speed over time', [[series.speed, colours.trunk]], 'm/s');
  timeChart('Probability that the left foot is the stance foot', 'Probability of left stance', [[series.left_stance, colours.left]], '', {scales: {y: {range: [-0.05, 1.05]}}});
  timeChart(`Effective number of particles (of ${run.config.filter.particles})`, 'Effective sample size over time',
    [[series.ess, colours.trunk], [times.map(() => run.config.filter.resample_below * run.config.filter.particles), '#b0b8c0', 1]], '', {scales: {y: {range: (u, min, max) => [0, max * 1.05]}}});
  const residuals = Object.keys(series).filter((name) => name.startsWith('keypoint_residual_px.'));
  if (residuals.length > 0) {
    const strokes = [colours.trunk, colours.left, colours.right];
    timeChart('Distance of the detected points from the reported pose, median of a frame', 'Distance of detected keypoints from the pose over time, a line for each camera',
      residuals.map((name, i) => [series[name], strokes[i % strokes.length]]), 'px');
  }
  timeChart('Log-evidence of the frame', 'Log-evidence over time', [[series.log_evidence, colours.trunk]], 'nats');
}
