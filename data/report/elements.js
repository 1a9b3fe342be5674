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

// A file for whoever reads the page: the browser asks nobody for it.
function save(name, content) {
  const link = element('a', {href: URL.createObjectURL(content), download: name});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}
const fileName = (words, ending) => words.toLowerCase().replace(/[^a-z0-9]+/g, '_').replace(/^_+|_+$/g, '') + ending;

function saveButton(label, description, act) {
  const button = element('button', {type: 'button', className: 'save', onclick: act}, label);
  button.setAttribute('aria-label', description);
  return button;
}

// Rows of numbers, text and null as CSV.
function csvOf(head, rows) {
  const cell = (value) => value === null || value === undefined || Number.isNaN(value) ? '' :
    /[",\n]/.test(value) ? `"${String(value).replaceAll('"', '""')}"` : String(value);
  return new Blob([[head, ...rows].map((row) => row.map(cell).join(',') + '\n').join('')], {type: 'text/csv'});
}

// A table as it is shown: numbers with a band (their node has `band`) take three columns.
function shownAsCsv(head, rows) {
  const wide = head.map((_, i) => rows.some((row) => row[i].band));
  const words = (content) => content.childNodes ? [...content.childNodes].map((child) => child.textContent.trim()).join(' ') : content;
  const plain = (content) => words(content).replace(/^–$/, '').replace('−', '-');
  return csvOf(head.flatMap((name, i) => wide[i] ? [name, name + ' p05', name + ' p95'] : [name]),
    rows.map((row) => row.flatMap((content, i) => !wide[i] ? [plain(content)] : content.band ?? [plain(content), null, null])));
}

// Numbers stand on the right: columns of nothing else.
const isNumber = (content) => /^([−+]?\d([^A-Za-z]| to )*|–)$/.test(content.textContent ?? content);

// `name`, if there is one: what the table's file is called.
function table(head, rows, name = '') {
  const numeric = head.map((_, i) => rows.some((row) => row[i] !== '–') && rows.every((row) => isNumber(row[i])));
  const line = (cells, tag) => element('tr', {}, ...cells.map((content, i) => {
    const made = element(tag === 'td' && i === 0 ? 'th' : tag, {className: numeric[i] ? 'number' : 'word'}, content);
    if (made.tagName === 'TH') made.scope = tag === 'th' ? 'col' : 'row';
    return made;
  }));
  const made = element('div', {className: 'scroll'}, element('table', {},
    element('thead', {}, line(head, 'th')), element('tbody', {}, ...rows.map((row) => line(row, 'td')))));
  if (name) made.append(saveButton('CSV', `Save the table ${name} as CSV`, () => save(fileName(name, '.csv'), shownAsCsv(head, rows))));
  return made;
}
