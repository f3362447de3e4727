import { addCurves } from './curves.js';
import { element } from './elements.js';
import { addOutcome, addPictures, addProvenance, addSettings, addSetup, addSummary, addTimings, addTrust } from './sections.js';
import { addPopulation } from './population.js';
import { addView } from './view.js';

const data = JSON.parse(document.getElementById('data').textContent);

function showRemarks() {
  const remarks = [
    ...(data.summary?.warnings ?? []).map((text) => ['warning', text]),
    ...(data.summary?.notes ?? []).map((text) => ['note', text]),
    ...data.remarks.map((text) => ['note', text]),
  ];
  document.querySelector('header').append(
    ...remarks.map(([kind, text]) => element('p', { className: `remark ${kind}` }, element('strong', {}, `${kind}: `), text)));
}

async function show() {
  document.getElementById('title').textContent = data.title;
  showRemarks();
  if (data.kind === 'population') {
    addPopulation(data);
    document.documentElement.dataset.state = 'ready';
    return;
  }
  if (data.kind === 'run') addOutcome(data.summary);
  if (data.summary) addSummary(data.summary, data.error_bars);
  if (data.kind === 'setup') addSetup(data);
  if (data.scene) await addView(data.scene);
  if (data.history) await addCurves(data.history);
  if (data.pictures?.length > 0) addPictures(data.pictures);
  if (data.summary) addTrust(data.summary, data.error_bars);
  addSettings(data.summary?.settings ?? data.settings);
  if (data.summary) addTimings(data.summary.wall_time_s);
  if (data.summary) addProvenance(data.summary, data.program);
  document.documentElement.dataset.state = 'ready';  // for those who wait for it
}

show().catch((error) => {
  document.documentElement.dataset.state = 'failed';
  document.querySelector('header').append(
    element('p', { className: 'remark warning' }, `This page could not be shown as a whole: ${error.message}. A newer browser may do.`));
  throw error;
});
