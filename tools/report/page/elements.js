/** An element with attributes (functions listen, other values are properties where there are such) and children. */
export function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null) continue;
    if (typeof value === 'function') node.addEventListener(name, value);
    else if (name in node && name !== 'list') node[name] = value;
    else node.setAttribute(name, value);
  }
  node.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return node;
}

/** A part of the page with a heading, reached from the list of contents. */
export function addSection(id, title, ...children) {
  const section = element('section', { id }, element('h2', {}, title), ...children);
  document.getElementById('sections').append(section);
  document.getElementById('contents').append(element('a', { href: `#${id}` }, title));
  return section;
}

/** Rows of cells below their heading. */
export function table(rows, heading) {
  const row = (cells, tag) => element('tr', {}, ...cells.map((cell) => element(tag, {}, cell)));
  return element('div', { className: 'wide' }, element('table', { className: 'rows' },
    element('thead', {}, row(heading, 'th')), element('tbody', {}, ...rows.map((cells) => row(cells, 'td')))));
}

/** A name that may break behind its dots and underscores. */
const breakable = (name) => String(name).split(/(?<=[._])/).flatMap((part) => [part, document.createElement('wbr')]);

/** Rows of [name, value], in as many columns as there is room for. */
export function pairs(rows) {
  return element('dl', {}, ...rows.map(([name, value]) => element('div', {}, element('dt', {}, ...breakable(name)), element('dd', {}, value))));
}
