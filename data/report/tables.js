// Words and numbers: the verdict, key figures, gait, quality, origin.
// "0.61" with its 5-95 % band in small print.
function banded(band, digits, factor = 1) {
  if (!band || band.value === null) return '–';
  const made = element('span', {}, fixed(factor * band.value, digits));
  made.band = [band.value, band.p05, band.p95].map((value) => value === null ? null : +(factor * value).toPrecision(12));
  if (band.p05 !== null)
    made.append(' ', element('small', {}, `${fixed(factor * band.p05, digits)} to ${fixed(factor * band.p95, digits)}`));
  return made;
}

function verdict() {
  const good = ['tracked', 'optimised'].includes(run.status) || analysed;
  const words = {'tracked': 'Tracked; every quality check passed', 'not found': 'Nobody was found walking',
    'below gates': 'Tracked, but a quality check failed: do not use these numbers before you have looked at the video', 'interrupted': 'Interrupted; what was done is shown',
    'cut short': 'Cut short by a broken video; what came before is shown',
    'optimised': 'Optimised: the track of another tool, with bones that keep their lengths and feet on the floor',
    'analysed': 'Analysed: gait, angles and forces of a motion that was there already'}[run.status] ?? run.status;
  byId('title').textContent = data.title;
  byId('verdict').className = 'verdict ' + (good ? 'good' : 'bad');
  byId('verdict').textContent = [words, ...run.notes].join(': ');
}

function keyFigures() {
  const both = data.gait.summary.both;
  const figure = (value, unit, name) =>
    element('li', {}, element('b', {}, value, ' ', element('small', {}, unit)), element('span', {}, name));
  const mean = (column, digits, unit, name) => {
    const made = figure(fixed(both[column].value, digits), unit, name);
    const {p05, p95} = both[column];
    if (p05 !== null) made.append(element('span', {}, `${fixed(p05, digits)} to ${fixed(p95, digits)}`));
    return made;
  };
  byId('key-figures').append(
    mean('speed_m_s', 2, 'm/s', 'walking speed'),
    mean('step_length_m', 2, 'm', 'step length'),
    mean('cadence_steps_per_min', 0, '/min', 'cadence'),
    mean('step_width_m', 2, 'm', 'step width'),
    mean('stance_percent', 0, '%', 'stance of the stride'),
    figure(`${run.numbers.tracked_frames}`, `of ${run.numbers.frames}`, run.command === 'track' ? 'frames tracked' : 'frames with both legs'));
  if (run.command === 'track') {
    const speed = figure(fixed(run.timing.frames_per_second, 1), '/s', `frames, ${plural(run.timing.threads, 'thread')}`);
    const stride = run.timing.stride_frames_per_second;
    if (stride !== null) speed.append(element('span', {}, `${fixed(stride, 1)} in the stride`));
    byId('key-figures').append(speed);
  }
}

const summaryRows = [
  ['speed_m_s', 'Walking speed, m/s', 2], ['cadence_steps_per_min', 'Cadence, steps/min', 0],
  ['step_length_m', 'Step length, m', 3], ['step_width_m', 'Step width, m', 3], ['step_time_s', 'Step time, s', 3],
  ['stride_length_m', 'Stride length, m', 3], ['stride_time_s', 'Stride time, s', 3], ['stance_percent', 'Stance, % of stride', 1],
  ['swing_percent', 'Swing, % of stride', 1], ['double_support_percent', 'Double support, % of stride', 1],
  ['walking_base_m', 'Walking base, m', 3], ['toe_clearance_m', 'Toe clearance, m', 3], ['foot_progression_deg', 'Foot progression, ° outwards', 1],
  ['step_length_sd_m', 'Step length, SD over steps, m', 3], ['step_time_sd_s', 'Step time, SD over steps, s', 3],
];
const symmetryOf = {step_length_m: 'step_length_percent', step_time_s: 'step_time_percent', stance_percent: 'stance_percent'};

function gaitTables() {
  const {summary, contacts} = data.gait;
  const into = byId('gait-tables');
  if (!contacts.length) {
    into.append(element('p', {}, 'The tracked figure took no step.'));
    return;
  }
  into.append(element('p', {}, `${plural(summary.steps, 'step')}, ${plural(summary.strides, 'stride')}${summary.turning_steps ? `; at ${plural(summary.turning_steps, 'step')} the direction of walking turns by more than 10°` : ''}.`),
    table(['mean', 'both', 'left', 'right', 'asymmetry, %'], summaryRows.map(([column, name, digits]) =>
      [name, ...['both', 'left', 'right'].map((side) => banded(summary[side][column], digits)), banded(summary.symmetry[symmetryOf[column]], 1)]), 'gait'),
    element('h3', {}, 'Contacts'),
    table(['foot', 'strike, s', 'toe-off, s', 'step length, m', 'step width, m', 'step time, s', 'stance, %'],
      contacts.map((c) => [c.side, banded(c.foot_strike_s, 3), banded(c.toe_off_s, 3), banded(c.step_length_m, 3),
        banded(c.step_width_m, 3), banded(c.step_time_s, 3), banded(c.stance_percent, 1)]), 'contacts'),
    element('p', {className: 'note'}, (analysed ? '' : 'Small figures: 5–95 %. ') + data.gait.notes.join(' ')));
}

function quality() {
  const rows = run.quality.map((q) => {
    const limit = q.gate === null ? '–' : `${q.at_most ? 'at most' : 'at least'} ${+q.gate.toPrecision(6)}${q.unit ? ' ' + q.unit : ''}`;
    const words = element('span', {}, q.what, element('small', {}, q.meaning));
    if (!q.passed) words.append(element('small', {className: 'bad'}, q.advice));
    return [words, `${fixed(q.value, q.digits)}${q.unit ? ' ' + q.unit : ''}`, limit, q.gate === null ? '–' : q.passed ? 'passed' : 'failed'];
  });
  const made = table(['check', 'value', 'allowed', ''], rows, 'quality');
  for (const cell of made.querySelectorAll('td:last-child'))
    cell.className = {passed: 'good', failed: 'bad'}[cell.textContent] ?? '';
  byId('quality-table').append(made);
  const spans = [];
  data.joints.mean_mm.forEach((row, i) => {
    if (row) return;
    const last = spans[spans.length - 1];
    if (last && last[1] === i - 1) last[1] = i; else spans.push([i, i]);
  });
  byId('lost-spans').textContent = spans.length
    ? (analysed ? 'Empty: ' : 'Not tracked: ') + spans.map(([a, b]) => `frames ${a}–${b} (${fixed(times[a], 2)}–${fixed(times[b] + 1 / data.rate, 2)} s)`).join(', ') + '.'
    : analysed ? '' : 'Every frame is tracked.';
}

// What was estimated for the whole video, with its band from 5 to 95 %.
function constants() {
  if (!run.constants?.length) return;
  byId('constants').append(element('h3', {}, 'Estimated for the whole video'),
    table(['', 'estimate', 'unit', 'effect on the result'], run.constants.map((c) => {
      const reach = 1.6449 * c.sd;
      return [c.what, banded({value: c.value, p05: c.value - reach, p95: c.value + reach}, c.digits), c.unit, c.effect];
    }), 'constants'));
}

function origin() {
  const changed = Object.entries(run.config_origin).map(([key, place]) => `${key} (${place})`).join(', ');
  const stages = Object.entries(run.timing.stage_seconds).map(([name, s]) => `${name} ${fixed(s, 1)} s`).join(', ');
  const code = (text) => element('code', {}, text);
  byId('origin-table').append(table(['', ''], [
    ['Program', `${run.program.name} ${run.program.version}, commit ${run.program.commit}, ${run.program.build}, ${run.program.compiler}`],
    [analysed ? 'Motion' : 'Scene', code(`${run.scene.file}  sha256 ${run.scene.sha256}`)],
    ['Cameras', data.cameras.map((c) => `${c.name}, ${c.size_px.join(' × ')} px`).join('; ') || 'none'],
    ['Subject', `stature ${data.subject.height_m} m, mass ${data.subject.mass_kg} kg`],
    ['Frames', `${run.numbers.frames} at ${+data.rate.toPrecision(5)} Hz`],
    ['Seed', `${run.seed}`],
    ['Settings changed', changed || 'none: the defaults'],
    ['Time', `${fixed(run.timing.seconds, 1)} s on ${plural(run.timing.threads, 'thread')}${stages && ': ' + stages}`],
    ['Command', code(run.timing.command_line.join(' '))],
    ['Digest of the result', code(run.digest)],
  ]));
  byId('settings').append(table(['key', 'value', 'set by'],
    leaves(run.config).map(([key, value]) => [code(key), JSON.stringify(value), run.config_origin[key] ?? 'default']), 'settings'));
  byId('run-json').textContent = JSON.stringify(run, null, 2);
  byId('run-json').before(saveButton('JSON', 'Save run.json', () => save('run.json', new Blob([byId('run-json').textContent + '\n'], {type: 'application/json'}))));
  byId('colophon').textContent = `Made by walktrack ${run.program.version}. The same inputs, settings and seed give the same digest. ` +
    'Drawn with uPlot and OGL, which are inside this page.';
}
