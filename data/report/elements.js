// Small things that every page uses. Nothing here, or below, turns text from outside into HTML: it
// only ever becomes text nodes.
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
