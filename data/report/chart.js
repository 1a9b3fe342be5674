// One chart, drawn with uPlot.
const axis = (label, size) => ({label, labelSize: 16, labelGap: 2, gap: 4, labelFont: '12px system-ui, sans-serif', font: '11px system-ui, sans-serif',
  size, stroke: '#5b6673', grid: {stroke: '#e6eaee', width: 1}, ticks: {stroke: '#d0d6dc', width: 1, size: 4}});

const faded = (hex, alpha) => hex + Math.round(alpha * 255).toString(16).padStart(2, '0');

function chart(parent, caption, description, height, options, values, remark = '', rough = false) {
  const holder = element('div', {className: 'chart', role: 'img'});
  holder.setAttribute('aria-label', description);
  parent.append(element('figure', {className: rough ? 'rough' : ''},
    element('figcaption', {}, element('b', {}, caption), element('small', {}, remark)), holder));
  const plot = new uPlot({width: Math.max(200, holder.clientWidth), height, legend: {show: false},
    cursor: {show: false}, padding: [8, 18, 0, 0], ...options}, values, holder);
  const fit = () => plot.setSize({width: Math.max(200, holder.clientWidth), height});
  new ResizeObserver(fit).observe(holder);
  window.addEventListener('beforeprint', fit);
  return plot;
}
