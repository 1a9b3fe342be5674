// Headings sort their column; a second time the other way round. Empty cells come last.
document.querySelectorAll('thead th').forEach((heading) => {
  const body = heading.closest('table').tBodies[0];
  const column = heading.cellIndex;
  const button = document.createElement('button');
  button.type = 'button';
  button.append(...heading.childNodes);
  heading.append(button);
  button.onclick = () => {
    const down = heading.ariaSort === 'ascending';
    for (const other of heading.parentNode.children) other.ariaSort = null;
    heading.ariaSort = down ? 'descending' : 'ascending';
    const text = (row) => row.cells[column].textContent;
    const order = new Intl.Collator(undefined, {numeric: true});
    const compare = (a, b) => {
      if (!text(a) || !text(b)) return (text(a) ? 0 : 1) - (text(b) ? 0 : 1);
      const sign = down ? -1 : 1;
      return sign * (heading.className === 'number' ? text(a) - text(b) : order.compare(text(a), text(b)));
    };
    body.append(...[...body.rows].sort(compare));
  };
});
