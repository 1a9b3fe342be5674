// Curves, drawn with uPlot: over the gait cycle with their bands, and over time.
const axis = (label, size) => ({label, labelSize: 16, labelGap: 2, gap: 4, labelFont: '12px system-ui, sans-serif', font: '11px system-ui, sans-serif',
  size, stroke: '#5b6673', grid: {stroke: '#e6eaee', width: 1}, ticks: {stroke: '#d0d6dc', width: 1, size: 4}});

const faded = (hex, alpha) => hex + Math.round(alpha * 255).toString(16).padStart(2, '0');

function chart(parent, caption, description, height, options, values) {
  const holder = element('div', {className: 'chart', role: 'img'});
  holder.setAttribute('aria-label', description);
  parent.append(element('figure', {}, element('figcaption', {}, element('b', {}, caption)), holder));
  const plot = new uPlot({width: Math.max(200, holder.clientWidth), height, legend: {show: false},
    cursor: {show: false}, padding: [8, 18, 0, 0], ...options}, values, holder);
  const fit = () => plot.setSize({width: Math.max(200, holder.clientWidth), height});
  new ResizeObserver(fit).observe(holder);
  window.addEventListener('beforeprint', fit);
  return plot;
}

const normal = (() => {
  const rows = data.normal_csv.split('\n').filter((line) => line && line[0] !== '#').map((line) => line.split(','));
  const head = rows.shift();
  return {percent: rows.map((r) => +r[0]), column: (name) => rows.map((r) => +r[head.indexOf(name)]),
    source: data.normal_csv.split('\n').filter((l) => l[0] === '#').map((l) => l.slice(2)).join(' ')};
})();

// The published range at every per cent of the cycle.
function normalAt(name) {
  const column = normal.column(name);
  return Array.from({length: 101}, (_, i) => {
    const below = Math.min(normal.percent.length - 2, Math.floor(i / 2)), share = (i - normal.percent[below]) / 2;
    return column[below] + share * (column[below + 1] - column[below]);
  });
}

const angleNames = {
  hip_flexion: ['Hip', 'extension − / flexion +'], knee_flexion: ['Knee', 'flexion +'],
  ankle_dorsiflexion: ['Ankle', 'plantar − / dorsiflexion +'], pelvis_tilt: ['Pelvis and trunk', 'lean forward +'],
};

function cycleChart(name) {
  const percent = Array.from({length: 101}, (_, i) => i);
  const series = [{}], values = [percent], bands = [];
  const band = (low, high, fill) => {
    values.push(high, low);
    series.push({stroke: 'transparent', width: 0, points: {show: false}}, {stroke: 'transparent', width: 0, points: {show: false}});
    bands.push({series: [series.length - 2, series.length - 1], fill});
  };
  const line = (points, stroke, width) => {
    values.push(points);
    series.push({stroke, width, points: {show: false}});
  };
  if (name !== 'pelvis_tilt') band(normalAt(name + '_low'), normalAt(name + '_high'), faded('#8b98a5', 0.3));
  const toeOffs = [];
  for (const side of sides) {
    const cycle = data.cycles.find((c) => c.angle === name && c.side === side);
    if (!cycle || !cycle.count) continue;
    for (const stride of cycle.strides) {
      if (cycle.count > 1) line(stride.values, faded(colours[side], 0.3), 1);
      if (stride.toe_off) toeOffs.push([100 * stride.toe_off, colours[side]]);
    }
    if (cycle.count > 1)
      band(cycle.mean.map((m, i) => m - cycle.sd[i]), cycle.mean.map((m, i) => m + cycle.sd[i]), faded(colours[side], 0.16));
    line(cycle.mean, colours[side], 2.5);
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
  const [caption, sign] = angleNames[name];
  chart(byId('cycle-charts'), caption, `${caption} angle over the gait cycle, left and right, beside the normal range`, 230,
    {series, bands, scales: {x: {time: false, range: [0, 100]}}, hooks: {draw: [marks]},
      axes: [axis('% of the gait cycle', 24), axis(`°  ${sign}`, 34)]}, values);
}

function startCycles() {
  const strides = Object.fromEntries(sides.map((side) => [side, Math.max(0, ...data.cycles.filter((c) => c.side === side).map((c) => c.count))]));
  if (strides.left + strides.right === 0) {
    byId('cycle-charts').append(element('p', {}, 'No whole stride, from one strike of a foot to its next, was tracked without a gap.'));
    return;
  }
  byId('curves').insertBefore(element('p', {className: 'key'}, element('i', {className: 'left'}), `left, ${plural(strides.left, 'stride')} `,
    element('i', {className: 'right'}), `right, ${plural(strides.right, 'stride')} `, element('i', {className: 'normal'}), 'normal range (mean ± 1 SD)'),
    byId('cycle-charts'));
  Object.keys(angleNames).forEach(cycleChart);
  const rows = [];
  for (const name of Object.keys(angleNames)) {
    for (const side of sides) {
      const cycle = data.cycles.find((c) => c.angle === name && c.side === side);
      if (!cycle || !cycle.count) continue;
      const low = Math.min(...cycle.mean), high = Math.max(...cycle.mean);
      const typical = name === 'pelvis_tilt' ? '–' : (() => {
        const mean = normalAt(name + '_low').map((v, i) => (v + normalAt(name + '_high')[i]) / 2);
        return `${fixed(Math.min(...mean), 0)} to ${fixed(Math.max(...mean), 0)}`;
      })();
      rows.push([`${angleNames[name][0]}, ${side}`, fixed(low, 1), fixed(high, 1), fixed(high - low, 1),
        fixed(cycle.mean.indexOf(high), 0), fixed(cycle.mean[0], 1), typical]);
    }
  }
  byId('motion-range').append(table(['mean curve, °', 'least', 'greatest', 'range', 'greatest at %', 'at strike', 'normal mean'], rows));
  byId('normal-note').textContent = `Thin lines are strides, the coloured band is their mean ± 1 SD, dashes mark toe-off. ${normal.source} ` +
    'The definitions differ (see the limits below): compare shape and range before level.';
}

function timeChart(caption, description, values, label, more = {}) {
  const lost = (u) => {
    u.ctx.fillStyle = '#00000012';
    data.joints.mean_mm.forEach((row, i) => {
      if (row) return;
      const from = u.valToPos((i - 0.5) / data.rate, 'x', true), to = u.valToPos((i + 0.5) / data.rate, 'x', true);
      u.ctx.fillRect(from, u.bbox.top, to - from, u.bbox.height);
    });
  };
  const now = (u) => {
    const x = u.valToPos(clock.frame / data.rate, 'x', true);
    u.ctx.strokeStyle = '#0b5a8a'; u.ctx.lineWidth = 1;
    u.ctx.beginPath(); u.ctx.moveTo(x, u.bbox.top); u.ctx.lineTo(x, u.bbox.top + u.bbox.height); u.ctx.stroke();
  };
  const plot = chart(byId('time-charts'), caption, description, 130,
    {series: [{}, ...values.map(([, stroke, width = 1.5]) => ({stroke, width, points: {show: false}}))],
      scales: {x: {time: false, range: [0, Math.max(times[lastFrame] || 0, 0.1)]}, ...more.scales},
      hooks: {draw: [lost, now, ...(more.draw ?? [])]}, axes: [axis('s', 24), axis(label, 44)]},
    [times, ...values.map(([v]) => v)]);
  clock.listeners.push(() => plot.redraw(false));
  plot.over.addEventListener('click', (event) => clock.show(plot.posToVal(event.offsetX, 'x') * data.rate));
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
  timeChart('Speed over the ground', 'Speed over time', [[series.speed, colours.trunk]], 'm/s');
  timeChart('Left foot carries the body: probability', 'Probability of left stance', [[series.left_stance, colours.left]], '', {scales: {y: {range: [-0.05, 1.05]}}});
  timeChart(`Effective number of particles (of ${run.config.filter.particles})`, 'Effective sample size over time',
    [[series.ess, colours.trunk], [times.map(() => run.config.filter.resample_below * run.config.filter.particles), '#b0b8c0', 1]], '', {scales: {y: {range: (u, min, max) => [0, max * 1.05]}}});
  timeChart('Log-evidence of the frame', 'Log-evidence over time', [[series.log_evidence, colours.trunk]], 'nats');
}
