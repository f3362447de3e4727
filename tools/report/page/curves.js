import uPlot from 'uplot';
import { addSection, element } from './elements.js';
import { shortNumber } from './numbers.js';
import { unpackDoubles } from './unpack.js';

// Okabe and Ito's colours, which people tell apart who see colours otherwise.
const COLOURS = ['#0072b2', '#d55e00', '#009e73', '#cc79a7'];
const SHOWN_AT_FIRST = 4;

const cursors = uPlot.sync('time');

/** Columns of one panel on one axis of time. */
function aligned(panel, columns, axes) {
  const shown = (value) => (Number.isNaN(value) ? null : value * panel.factor);  // null: a gap
  const tables = panel.columns.map((c) => [axes[columns[c].axis], columns[c].values.map(shown)]);
  if (tables.every(([times]) => times === tables[0][0])) return [tables[0][0], ...tables.map(([, values]) => values)];
  return uPlot.join(tables);
}

function drawPanel(panel, history, place) {
  const [times, ...values] = aligned(panel, history.columns, history.axes);
  const names = panel.columns.map((c) => history.columns[c].name.slice(panel.columns.length > 1 ? panel.title.length + 1 : 0));
  const text = (_, value) => (value === null || value === undefined ? '' : shortNumber(value));
  const plot = new uPlot({
    width: place.clientWidth, height: 240,
    title: panel.title + (panel.unit ? ` [${panel.unit}]` : ''),
    scales: { x: { time: false } },
    axes: [{ label: history.time.label, labelSize: 22, size: 34 }, { size: 62, values: (_, ticks) => ticks.map(shortNumber) }],
    series: [{ label: history.time.label.split(' ')[0], value: text }, ...names.map((label, i) => ({
      label, stroke: COLOURS[i % COLOURS.length], width: 1.75, value: text, points: { show: times.length < 40 },
    }))],
    cursor: { sync: { key: cursors.key }, drag: { x: true, y: true, uni: 20 } },
    legend: { live: true },
  }, [times, ...values], place);
  new ResizeObserver(() => plot.setSize({ width: place.clientWidth, height: 240 })).observe(place);
}

function panelChoice(panel, history, plots, isShown) {
  const place = element('div', { className: 'plot', hidden: !isShown });
  plots.append(place);
  let isDrawn = false;
  const show = (shown) => {
    place.hidden = !shown;
    if (shown && !isDrawn) drawPanel(panel, history, place);
    isDrawn ||= shown;
  };
  const box = element('input', { type: 'checkbox', checked: isShown, change: () => show(box.checked) });
  return { label: element('label', {}, box, ` ${panel.title}`), title: panel.title, show: () => show(box.checked) };
}

export async function addCurves(packed) {
  const history = {
    time: packed.time,
    axes: await Promise.all(packed.axes.map(async (times) => Array.from(await unpackDoubles(times), (time) => time * packed.time.factor))),
    columns: await Promise.all(packed.columns.map(async (column) => ({ ...column, values: Array.from(await unpackDoubles(column.values)) }))),
  };
  const plots = element('div', { className: 'plots' });
  const shown = packed.panels.filter((panel) => !panel.is_zero).slice(0, SHOWN_AT_FIRST);
  const choices = packed.panels.map((panel) => panelChoice(panel, history, plots, shown.includes(panel)));
  const search = element('input', {
    type: 'search', placeholder: 'find a probe', 'aria-label': 'find a probe',
    input: () => { for (const { label, title } of choices) label.hidden = !title.includes(search.value.trim()); },
  });
  addSection('curves', 'Curves',
    element('p', {}, `${packed.panels.length} probes over ${packed.rows} rows. Draw a box to zoom, double-click to see all again.`),
    element('div', { className: 'choices' }, search, element('div', { className: 'list' }, ...choices.map(({ label }) => label))), plots);
  for (const { show } of choices) show();
}
