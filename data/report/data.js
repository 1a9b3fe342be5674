// What the page of a track or an analysis was given.
const data = JSON.parse(document.getElementById('data').textContent);
const run = data.run;

// "a.b.c" of every leaf of the configuration.
function leaves(value, path = '') {
  if (value === null || typeof value !== 'object' || Array.isArray(value)) return [[path, value]];
  return Object.entries(value).flatMap(([key, inner]) => leaves(inner, path ? path + '.' + key : key));
}

const frames = data.joints.mean_mm.length;
const lastFrame = Math.max(0, frames - 1);
const times = data.times;
const frameAt = (time) => (time - (times[0] ?? 0)) * data.rate;
// Of a motion that came from elsewhere there is no video, no filter and no quality check.
const analysed = run.command === 'analyse';
const jointIndex = Object.fromEntries(data.joints.names.map((name, i) => [name, i]));

// Metres, or null where nobody was tracked or the body has no such joint.
function joint(frame, name, which = 'mean_mm') {
  const row = data.joints[which][frame];
  const at = 3 * jointIndex[name];
  return row && at + 2 < row.length && row[at] !== null ? [row[at] / 1000, row[at + 1] / 1000, row[at + 2] / 1000] : null;
}

// The one frame that video, figure and charts show. Listeners are told of changes.
const clock = {
  frame: 0,
  listeners: [],
  show(frame, source) {
    frame = Math.min(lastFrame, Math.max(0, Math.round(frame)));
    this.frame = frame;
    for (const listener of this.listeners) listener(frame, source);
  },
};
