import uPlot from 'uplot';
import { addSection, element, pairs, table } from './elements.js';
import { shortNumber } from './numbers.js';

const LOW = '#0072b2', HIGH = '#d55e00';  // Okabe and Ito: people tell them apart who see colours otherwise

const percent = (share) => `${shortNumber(100 * share)} %`;
/** In a unit that keeps numbers short: MPa for 1.4e6 Pa. */
function inShortUnit(output) {
  const most = output.spread ? Math.max(...output.spread.quantiles.map(([, value]) => Math.abs(value))) : 0;
  const [unit, size] = output.unit !== 'Pa' || most < 1e3 ? [output.unit, 1] : most < 1e6 ? ['kPa', 1e3] : ['MPa', 1e6];
  const inUnit = (value) => (value === null ? null : value / size);
  const { spread } = output;
  return {
    ...output,
    unit: unit.replace('^2', '²').replace('^3', '³'),
    at_medians: inUnit(output.at_medians),
    bars: output.bars.map((bar) => bar.map(inUnit)),
    extremes: output.extremes.map((extreme) => ({ ...extreme, value: inUnit(extreme.value) })),
    spread: spread && {
      ...spread,
      mean: inUnit(spread.mean),
      sd: inUnit(spread.sd),
      quantiles: spread.quantiles.map(([p, value]) => [p, inUnit(value)]),
      histogram: { ...spread.histogram, lowest: inUnit(spread.histogram.lowest), width: inUnit(spread.histogram.width) },
    },
  };
}

const withUnit = (value, unit) => (value === null ? 'no value' : shortNumber(value) + (unit ? ` ${unit}` : ''));

function drawHistogram({ lowest, width, counts }, label, place) {
  const middles = counts.map((_, i) => lowest + (i + 0.5) * width);
  const plot = new uPlot({
    width: place.clientWidth, height: 220,
    scales: { x: { time: false, range: [lowest - width / 2, lowest + (counts.length + 0.5) * width] }, y: { range: (_, __, most) => [0, Math.max(1, most)] } },
    axes: [{ label, labelSize: 22, size: 34, values: (_, ticks) => ticks.map(shortNumber) }, { label: 'cases', labelSize: 22, size: 44 }],
    series: [{ label }, { label: 'cases', fill: `${LOW}99`, stroke: LOW, paths: uPlot.paths.bars({ size: [1, Infinity] }), points: { show: false } }],
    legend: { show: false },
  }, [middles, counts], place);
  new ResizeObserver(() => plot.setSize({ width: place.clientWidth, height: 220 })).observe(place);
}

/** Rows of bars on one scale. @param rows  [name, [[from, to, colour, title]...], [text...]] */
function barRows(rows, lowest, highest, mark) {
  const place = (x) => `${(100 * (x - lowest)) / (highest - lowest || 1)}%`;
  const size = (from, to) => `${(100 * Math.abs(to - from)) / (highest - lowest || 1)}%`;
  const bar = ([from, to, colour, title]) => {
    const node = element('div', { className: 'span', title });
    Object.assign(node.style, { left: place(Math.min(from, to)), width: size(from, to), background: colour });
    return node;
  };
  const line = () => {
    const node = element('div', { className: 'mark' });
    node.style.left = place(mark);
    return node;
  };
  return element('div', { className: 'spans' }, ...rows.map(([name, bars, text]) => element('div', { className: 'spans-row' },
    element('span', {}, name), element('div', { className: 'track' }, ...bars.map(bar), mark === undefined ? null : line()),
    element('span', { className: 'spans-text' }, text))));
}

/** The parameter that does most comes first. */
function tornado(output, parameters) {
  const all = output.bars.map(([low, high], i) => ({ low, high, p: parameters[i] }));
  const known = all.filter(({ low, high }) => low !== null && high !== null);
  const missing = all.filter((bar) => !known.includes(bar)).map(({ p }) => p.name);
  if (output.at_medians === null || known.length === 0) return [];
  known.sort((a, b) => Math.abs(b.high - b.low) - Math.abs(a.high - a.low));
  const ends = [output.at_medians, ...known.flatMap(({ low, high }) => [low, high])];
  const rows = known.map(({ low, high, p }) => [p.name,
    [[output.at_medians, low, LOW, `${p.name} = ${withUnit(p.low, p.unit)}`], [output.at_medians, high, HIGH, `${p.name} = ${withUnit(p.high, p.unit)}`]],
    `${shortNumber(low)} at ${withUnit(p.low, p.unit)}, ${shortNumber(high)} at ${withUnit(p.high, p.unit)}`]);
  return [element('h3', {}, 'One parameter at a time'),
    element('p', {}, `All at their medians: ${withUnit(output.at_medians, output.unit)}. Blue: one alone at its 5 % quantile, orange: at 95 %.`),
    barRows(rows, Math.min(...ends), Math.max(...ends), output.at_medians),
    ...(missing.length > 0 ? [element('p', {}, `No bar, as a case failed: ${missing.join(', ')}.`)] : [])];
}

function indices(output, parameters, wanted) {
  if (output.indices.length === 0) return [];
  const order = output.indices.map((index, i) => ({ ...index, name: parameters[i].name })).sort((a, b) => b.total[0] - a.total[0]);
  const text = ([value, low, high]) => `${value.toFixed(2)} (${low.toFixed(2)} to ${high.toFixed(2)})`;
  const most = Math.max(1, ...order.flatMap(({ total, first }) => [total[2], first[2]]));
  const least = Math.min(0, ...order.flatMap(({ total, first }) => [total[1], first[1]]));
  const rows = order.flatMap(({ name, first, total }) => [
    [name, [[0, first[0], LOW, 'first order'], [first[1], first[2], '#00000055', '95 % interval']], `alone ${text(first)}`],
    ['', [[0, total[0], HIGH, 'total'], [total[1], total[2], '#00000055', '95 % interval']], `in all ${text(total)}`]]);
  return [element('h3', {}, 'Sobol indices'),
    element('p', {}, `Shares of the variance, from ${output.whole_rows} of ${wanted} rows. Grey: 95 % intervals.`), barRows(rows, least, most, 0)];
}

function spread({ count, mean, sd, quantiles }, unit) {
  return pairs([['cases', count], ['mean', withUnit(mean, unit)], ['standard deviation', withUnit(sd, unit)],
    ...quantiles.map(([p, value]) => [p === 0 ? 'least' : p === 1 ? 'largest' : p === 0.5 ? 'median' : `${percent(p)} quantile`, withUnit(value, unit)])]);
}

function extremes(output) {
  return element('div', { className: 'pictures' }, ...output.extremes.flatMap((extreme, i) => extreme.pictures.map(({ source, name }) => element('figure', {},
    element('img', { src: source, alt: name }),
    element('figcaption', {}, `${i === 0 ? 'least' : 'largest'}: ${withUnit(extreme.value, output.unit)}, ${extreme.case}. ${extreme.parameters.join(', ')}`)))));
}

function addOutput(output, data, number) {
  const plot = element('div', { className: 'plot' });
  const ranks = output.ranks.map((rank, i) => [data.parameters[i].name, rank === null ? 'none' : rank.toFixed(2)]);
  addSection(`output-${number}`, output.name,
    ...(output.spread ? [spread(output.spread, output.unit), plot] : []),
    ...tornado(output, data.parameters), ...indices(output, data.parameters, data.index_rows),
    ...(ranks.length > 0 && output.spread ? [element('h3', {}, 'Rank correlation'), pairs(ranks)] : []),
    ...(output.extremes.some(({ pictures }) => pictures.length > 0) ? [element('h3', {}, 'Extremes'), extremes(output)] : []));
  if (output.spread) drawHistogram(output.spread.histogram, output.name + (output.unit ? ` [${output.unit}]` : ''), plot);
}

export function addPopulation(data) {
  const verdict = document.getElementById('verdict');
  verdict.textContent = `${data.succeeded} of ${data.cases} cases succeeded`;
  verdict.className = `outcome ${data.succeeded === data.cases ? 'good' : 'bad'}`;
  document.querySelector('header').append(element('p', {}, data.words));
  if (data.failures.length > 0) addSection('failures', 'Failures', table(data.failures, ['case', 'how', 'message']));
  data.outputs.forEach((output, i) => addOutput(inShortUnit(output), data, i + 1));
  if (data.parameters.length > 0)
    addSection('parameters', 'Parameters', table(data.parameters.map(({ name, distribution }) => [name, distribution]), ['parameter', 'distribution']));
  addSection('program', 'Program', pairs([['articular', data.program]]));
}
