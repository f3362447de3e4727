import { addSection, element, pairs, table } from './elements.js';
import { seconds, shortNumber } from './numbers.js';

const words = (key) => key.replaceAll('_', ' ');

/** [["integrator.step_s", "0.0015"], ...] of what may be nested. */
function rowsOf(value, before = '') {
  if (value === null || typeof value !== 'object') return [[before, typeof value === 'number' ? shortNumber(value) : String(value)]];
  if (Array.isArray(value) && value.every((one) => one === null || typeof one !== 'object')) return [[before, value.join(', ')]];
  return Object.entries(value).flatMap(([key, inner]) => rowsOf(inner, before === '' ? key : `${before}.${key}`));
}

/** "0.3 s of 0.9 s", in statics "30 % of the load". */
function reached({ simulated_time_s: time, settings }) {
  const { duration_s: whole, analysis } = settings ?? {};
  return analysis === 'static' ? `${shortNumber((100 * time) / whole)} % of the load` : `${shortNumber(time)} s of ${shortNumber(whole)} s`;
}

function outcomeWords(summary) {
  const outcome = summary?.outcome;
  if (!outcome) return ['bad', 'There is no summary.json that says how the run ended.'];
  const until = `it came to ${reached(summary)}`;
  if (outcome === 'finished') return ['good', 'The run finished.'];
  if (outcome === 'unfinished') return ['bad', 'The run has not come to its end: it goes on, or was killed.'];
  if (outcome === 'interrupted') return ['bad', `The run was interrupted: ${until}.`];
  return ['bad', `The run ended early: ${outcome}; ${until}.`];
}

function errorBarWords(bars) {
  if (!bars) return 'not asked for (run --error-bars)';
  const verdict = bars.columns.indexOf('verdict');
  const sound = bars.rows.filter((row) => /^(negligible|asymptotic)/.test(row[verdict])).length;
  return `${bars.rows.length} quantities, ${sound} of them in the range where bars hold`;
}

export function addOutcome(summary) {
  const [kind, text] = outcomeWords(summary);
  document.getElementById('verdict').append(element('span', { className: `outcome ${kind}` }, text));
}

export function addSummary(summary, bars) {
  const { settings = {}, size = {} } = summary;
  const rows = [
    ['scenario', summary.scenario],
    ['analysis', settings.analysis],
    ['accuracy', settings.accuracy],
    ['computed', summary.simulated_time_s === undefined ? undefined : reached(summary)],
    ['tissue', size.tetrahedra === undefined ? undefined : `${size.tetrahedra} tetrahedra`],
    ['bodies', size.bodies],
    ['unknown velocities', size.unknown_velocities],
    ['muscles, ligaments', size.muscles === undefined ? undefined : `${size.muscles}, ${size.ligaments}`],
    ['pairs of bodies that may touch', size.contact_pairs],
    ['deepest penetration', summary.max_penetration_m === undefined ? undefined : `${shortNumber(1e6 * summary.max_penetration_m)} µm`],
    ['error bars', errorBarWords(bars)],
    ['warnings', summary.warnings?.length],
    ['wall time', summary.wall_time_s ? `${seconds(summary.wall_time_s.total)} with ${summary.threads} thread${summary.threads === 1 ? '' : 's'}` : undefined],
    ['program', summary.versions ? `articular ${summary.versions.articular}` : undefined],
  ].filter(([, value]) => value !== undefined && value !== null);
  addSection('summary', 'Summary', pairs(rows.map(([name, value]) => [name, String(value)])));
}

export function addSetup({ scenario, counts }) {
  document.getElementById('verdict').append(
    element('span', { className: 'outcome' }, `The set-up of ${scenario} before the first step. Nothing has been run.`));
  addSection('summary', 'Summary', pairs(counts));
}

export function addPictures(pictures) {
  addSection('pictures', 'Pictures', element('div', { className: 'pictures' },
    ...pictures.map(({ name, source }) => element('figure', {},
      element('img', { src: source, alt: name }), element('figcaption', {}, name)))));
}

function energyRows({ start, end = {}, ...rest }) {
  const works = Object.entries(rest).filter(([key]) => key.endsWith('_work') || key.endsWith('_loss'));
  return [
    ['total at the start', shortNumber(start)],
    ...works.filter(([, value]) => value !== 0).map(([key, value]) => [words(key), shortNumber(value)]),
    ...Object.entries(end).map(([key, value]) => [`${words(key)} at the end`, shortNumber(value)]),
  ];
}

export function addTrust(summary, bars) {
  const parts = [];
  const add = (title, ...content) => parts.push(element('h3', {}, title), ...content);
  if (bars) add('Error bars', element('p', {}, 'How far each number may be from that of elements, steps and penetrations of size zero.'), table(bars.rows, bars.columns.map(words)));
  if (summary.target_error) add('Target of the error', element('p', {}, `How far ${summary.target_error.of} may be from that of elements, steps and penetrations of size zero, and the settings that were chosen for it.`), pairs(rowsOf(summary.target_error)));
  if (summary.energy) add(`Energy [${summary.energy.unit}]`, element('p', {}, 'The total at the end is the start, plus works, less losses. Numerical loss is what the time integration took.'), pairs(energyRows(summary.energy)));
  if (summary.counts) add('Steps and iterations', pairs(rowsOf(summary.counts).map(([key, value]) => [words(key), value])));
  if (summary.error_bars) add('Coarser runs', pairs(rowsOf(summary.error_bars)));
  if (summary.overlap_resolution) add('Overlaps before the start', pairs(rowsOf(summary.overlap_resolution)));
  if (parts.length > 0) addSection('trust', 'Why to trust it', ...parts);
}

export function addSettings(settings) {
  if (settings) addSection('settings', 'Settings', pairs(rowsOf(settings)));
}

export function addTimings(times) {
  if (!times?.total) return;
  const phases = Object.entries(times).filter(([key]) => key !== 'total');
  const rest = times.total - phases.reduce((sum, [, value]) => sum + value, 0);
  const bar = ([key, value]) => {
    const share = Math.max(0, (100 * value) / times.total);
    return element('tr', {}, element('td', {}, words(key)), element('td', { className: 'number' }, seconds(Math.max(0, value))),
      element('td', { className: 'number' }, `${share.toFixed(1)} %`),
      element('td', { className: 'bars' }, element('div', { className: 'bar', style: `width: ${share}%` })));
  };
  addSection('timings', 'Timings', element('p', {}, `${seconds(times.total)} of wall time in all.`),
    element('div', { className: 'wide' }, element('table', { className: 'rows timings' },
      element('tbody', {}, ...[...phases, ['other', rest]].map(bar)))));
}

export function addProvenance(summary, program) {
  const { versions, processor, build, inputs, input_files: files } = summary;
  addSection('provenance', 'Where it is from',
    pairs(rowsOf({ versions, processor, build, hash_of_all_inputs: inputs, peak_memory_MB: summary.peak_memory_MB, report_made_by: `articular ${program}` })
      .filter(([, value]) => value !== 'undefined')),
    files?.length > 0 ? table(files.map(({ file, bytes, fnv1a_64: hash }) => [file, String(bytes), hash]), ['input file', 'bytes', 'hash (FNV-1a)']) : null);
}
