// One chart, drawn with uPlot.
const axis = (label, size) => ({label, labelSize: 16, labelGap: 2, gap: 4, labelFont: '12px system-ui, sans-serif', font: '11px system-ui, sans-serif',
  size, stroke: '#5b6673', grid: {stroke: '#e6eaee', width: 1}, ticks: {stroke: '#d0d6dc', width: 1, size: 4}});

const faded = (hex, alpha) => hex + Math.round(alpha * 255).toString(16).padStart(2, '0');

// The chart on white below its caption.
function pictureOf(plot, caption) {
  const drawn = plot.ctx.canvas, scale = devicePixelRatio, above = Math.round(28 * scale);
  const canvas = element('canvas', {width: drawn.width, height: drawn.height + above}), context = canvas.getContext('2d');
  context.fillStyle = '#fff';
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.fillStyle = '#1c2530';
  context.font = `600 ${Math.round(14 * scale)}px system-ui, sans-serif`;
  context.fillText(caption, 8 * scale, 19 * scale);
  context.drawImage(drawn, 0, above);
  return new Promise((done) => canvas.toBlob(done, 'image/png'));
}

// `columns`: names of the values for whoever saves them; without a name they are not saved.
function chart(parent, caption, description, height, options, values, remark = '', rough = false, columns = []) {
  const holder = element('div', {className: 'chart', role: 'img'});
  holder.setAttribute('aria-label', description);
  const saves = element('span', {className: 'saves'});
  parent.append(element('figure', {className: rough ? 'rough' : ''},
    element('figcaption', {}, element('b', {}, caption), element('small', {}, remark), saves), holder));
  const plot = new uPlot({width: Math.max(200, holder.clientWidth), height, legend: {show: false},
    cursor: {show: false}, padding: [8, 18, 0, 0], ...options}, values, holder);
  const fit = () => plot.setSize({width: Math.max(200, holder.clientWidth), height});
  new ResizeObserver(fit).observe(holder);
  window.addEventListener('beforeprint', fit);
  saves.append(saveButton('PNG', `Save the chart ${caption} as a picture`, async () => save(fileName(caption, '.png'), await pictureOf(plot, caption))));
  const kept = columns.map((_, i) => i).filter((i) => columns[i]);
  if (kept.length > 1)
    saves.append(saveButton('CSV', `Save the numbers of the chart ${caption} as CSV`, () => save(fileName(caption, '.csv'),
      csvOf(kept.map((i) => columns[i]), Array.from(values[0], (_, row) => kept.map((i) => values[i][row]))))));
  return plot;
}
