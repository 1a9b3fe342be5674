// What the page was given, and small things that all its parts use. Nothing here, or below, turns
// text from outside into HTML: it only ever becomes text nodes.
const data = JSON.parse(document.getElementById('data').textContent);
const run = data.run;
const colours = {left: '#0072b2', right: '#d55e00', trunk: '#3a4450', normal: '#c9d1d9'};
const sides = ['left', 'right'];
const byId = (id) => document.getElementById(id);

function element(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in made) made[name] = value; else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

const plural = (count, word) => `${count} ${word}${count === 1 ? '' : 's'}`;

const fixed = (value, digits) =>
  value === null || value === undefined || !isFinite(value) ? '–' : value.toFixed(digits).replace('-', '−');

// Numbers stand on the right: columns of nothing else.
const isNumber = (content) => /^([−+]?\d([^A-Za-z]| to )*|–)$/.test(content.textContent ?? content);

function table(head, rows) {
  const numeric = head.map((_, i) => rows.some((row) => row[i] !== '–') && rows.every((row) => isNumber(row[i])));
  const line = (cells, tag) => element('tr', {}, ...cells.map((content, i) => {
    const made = element(tag === 'td' && i === 0 ? 'th' : tag, {className: numeric[i] ? 'number' : 'word'}, content);
    if (made.tagName === 'TH') made.scope = tag === 'th' ? 'col' : 'row';
    return made;
  }));
  return element('div', {className: 'scroll'}, element('table', {},
    element('thead', {}, line(head, 'th')), element('tbody', {}, ...rows.map((row) => line(row, 'td')))));
}

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
