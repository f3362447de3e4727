// The section with the 3D view and what steers it.
import { fieldTitle, naturalRange } from './colours.js';
import { addSection, element } from './elements.js';
import { unpackScene } from './frames.js';
import { shortNumber } from './numbers.js';
import { makeOverlay } from './overlay.js';
import { makeScene } from './scene.js';

const kBoneOpacity = 0.3;  // of bones in front of tissue

const labelled = (text, ...inputs) => element('label', { className: 'row' }, element('span', {}, text), ...inputs);
const option = (value, text, selected) => element('option', { value, selected }, text);

/** A slider over the frames, and a button that plays them. */
function timeControls(moments, showFrame) {
  const label = element('output', {});
  const slider = element('input', { type: 'range', min: 0, max: moments.length - 1, value: 0, 'aria-label': 'time', input: () => show() });
  let timer = null;
  function show() {
    label.textContent = moments[slider.valueAsNumber];
    showFrame(slider.valueAsNumber);
  }
  function stop() {
    clearInterval(timer);
    timer = null;
    play.textContent = '▶';
  }
  function next() {
    slider.valueAsNumber = (slider.valueAsNumber + 1) % moments.length;
    show();
    if (slider.valueAsNumber === moments.length - 1) stop();
  }
  const play = element('button', {
    type: 'button', title: 'play', click: () => {
      if (timer) return stop();
      play.textContent = '⏸';
      timer = setInterval(next, 80);
      return undefined;
    },
  }, '▶');
  slider.valueAsNumber = moments.length - 1;
  return { node: element('div', { className: 'time', hidden: moments.length < 2 }, play, slider, label), show };
}

/** Which field, its colours and their range. */
function fieldControls(packed, view, changed) {
  const fields = packed.fields.filter((field) => field.name !== 'length' || packed.lines.size > 0);
  const preferred = ['von_mises', 'contact_pressure'].find((name) => fields.some((field) => field.name === name)) ?? '';
  const bar = element('div', { className: 'colour-bar' });
  const ticks = element('div', { className: 'ticks' });
  const name = element('div', { className: 'field-name' });
  const legend = element('div', { className: 'legend' }, name, bar, ticks);
  const low = element('input', { type: 'number', step: 'any', 'aria-label': 'lowest colour', change: () => applyRange() });
  const high = element('input', { type: 'number', step: 'any', 'aria-label': 'highest colour', change: () => applyRange() });
  const range = element('div', { className: 'row' }, element('span', {}, 'range'), low, high, element('button', { type: 'button', click: () => choose() }, 'reset'));
  const select = element('select', { name: 'field', change: () => choose() }, option('', 'none', preferred === ''),
    ...fields.map((field) => option(field.name, fieldTitle(field.name), field.name === preferred)));
  let [field, map] = [null, 'viridis'];

  function applyRange() {
    const ends = [low.valueAsNumber, high.valueAsNumber];
    if (!(ends[0] < ends[1])) return;
    const stops = packed.colour_maps[map];
    view.setColours(stops, ends[0] / field.factor, ends[1] / field.factor);
    bar.style.background = `linear-gradient(to right, ${stops.join(', ')})`;
    name.textContent = fieldTitle(field.name) + (field.unit ? ` [${field.unit}]` : '');
    ticks.replaceChildren(...[ends[0], (ends[0] + ends[1]) / 2, ends[1]].map((end) => element('span', {}, shortNumber(end))));
    view.setField(field.name);
    changed();
  }
  function choose() {
    field = fields.find((one) => one.name === select.value) ?? null;
    legend.hidden = range.hidden = !field;
    if (!field) {
      view.setField(null);
      return changed();
    }
    const natural = naturalRange(field, packed);
    map = natural.map;
    const rounded = (value) => Number((value * field.factor).toPrecision(3));
    [low.value, high.value] = [rounded(natural.low), rounded(natural.high)];
    return applyRange();
  }
  return {
    nodes: fields.length > 0 ? [labelled('field', select), range] : [], legend, choose,
    told: (value) => (field && value !== null && value !== undefined && !Number.isNaN(value)
      ? `${fieldTitle(field.name)} ${shortNumber(value * field.factor)} ${field.unit}`.trim() : ''),
  };
}

function clipControls(packed, view, changed) {
  const [low, high] = view.box;
  const digits = Math.max(0, 2 - Math.floor(Math.log10(Math.max(...high.map((x, k) => x - low[k])) || 1)));
  const names = ['x', 'y', 'z'].map((letter, k) => (packed.directions[k] ? `${letter} (${packed.directions[k]})` : letter));
  const place = element('input', { type: 'range', min: 0, max: 1000, value: 500, disabled: true, 'aria-label': 'place of the plane', input: () => apply() });
  const flip = element('input', { type: 'checkbox', disabled: true, change: () => apply() });
  const told = element('output', {});
  const axis = element('select', { name: 'cut', change: () => apply() }, option('', 'none', true), ...names.map((text, k) => option(String(k), `across ${text}`)));
  function apply() {
    place.disabled = flip.disabled = axis.value === '';
    if (axis.value === '') {
      told.textContent = '';
      view.setClip(null);
      return changed();
    }
    const k = Number(axis.value);
    const at = low[k] + ((high[k] - low[k]) * place.valueAsNumber) / 1000;
    told.textContent = `${at.toFixed(digits)} ${packed.length_unit}`;
    view.setClip({ axis: k, at, sign: flip.checked ? -1 : 1 });
    return changed();
  }
  return [labelled('cut', axis), element('div', { className: 'row' }, place, told), labelled('other side', flip)];
}

/** Whether each part is drawn, and how opaque. */
function partRow({ name, isBone, isMark, actor }, hasTissue, changed) {
  const seen = element('input', {
    type: 'checkbox', checked: true, change: () => {
      actor.setVisibility(seen.checked);
      changed();
    },
  });
  const opacity = element('input', {
    type: 'range', min: 0.05, max: 1, step: 0.05, value: isBone && hasTissue ? kBoneOpacity : 1, 'aria-label': `opacity of ${name}`,
    input: () => {
      actor.getProperty().setOpacity(opacity.valueAsNumber);
      changed();
    },
  });
  actor.getProperty().setOpacity(opacity.valueAsNumber);
  return element('div', { className: 'part' }, element('label', { title: name }, seen, ` ${name}`), isMark ? null : opacity);
}

/** Tells what was clicked on; a drag turns the scene and tells nothing. */
function tellClicks(place, readout, view, told, unit) {
  let start = null;
  place.addEventListener('pointerdown', (event) => { start = [event.clientX, event.clientY]; }, true);
  place.addEventListener('pointerup', (event) => {
    if (!start || Math.hypot(event.clientX - start[0], event.clientY - start[1]) > 4) return;
    const corner = place.getBoundingClientRect();
    const hit = view.pick(event.clientX - corner.left, event.clientY - corner.top);
    if (!hit) return readout.replaceChildren('Nothing there. Click on a body to read it.');
    const words = [told(hit.value), `at (${hit.at.map((x) => x.toFixed(1)).join(', ')}) ${unit}`].filter(Boolean).join(', ');
    const details = hit.details.map(([key, value]) => element('div', {}, `${key}: ${value}`));
    return readout.replaceChildren(element('strong', {}, hit.name), ` ${words}`, ...details);
  }, true);
}

export async function addView(packedScene) {
  const packed = await unpackScene(packedScene);
  const stage = element('div', { className: 'stage' });
  const readout = element('div', { className: 'readout' }, 'Drag to turn, scroll or pinch to zoom, shift and drag to move. Click on a body to read it.');
  const panel = element('div', { className: 'panel' });
  const around = element('div', { className: 'view' }, element('div', { className: 'picture' }, stage), panel);
  addSection('view', '3D view', around);

  const overlay = makeOverlay(packed);
  const view = makeScene(packed, stage, overlay.show);
  const field = fieldControls(packed, view, view.render);
  const time = timeControls(packed.moments, (frame) => {
    view.setFrame(frame);
    view.render();
  });
  const viewpoint = element('select', {
    change: () => {
      view.lookFrom(packed.views[viewpoint.value]);
      view.render();
    },
  }, ...Object.keys(packed.views).map((name) => option(name, name)));
  const shaded = element('input', { type: 'checkbox', name: 'shading', checked: true, change: () => look() });
  const edges = element('input', { type: 'checkbox', change: () => look() });
  function look() {
    view.setLook({ isShaded: shaded.checked, hasEdges: edges.checked });
    view.render();
  }

  stage.append(...overlay.nodes, field.legend);
  around.firstChild.append(time.node, readout);
  const hasTissue = packed.bodies.some(({ isTissue }) => isTissue);
  panel.append(labelled('from', viewpoint), ...field.nodes,
    labelled('shading (darkens colours)', shaded), labelled('mesh edges', edges),
    ...clipControls(packed, view, view.render),
    element('h3', {}, 'Parts and their opacity'), ...view.parts.map((part) => partRow(part, hasTissue, view.render)));
  tellClicks(stage, readout, view, field.told, packed.length_unit);
  field.choose();
  view.lookFrom(Object.values(packed.views)[0]);
  time.show();
  view.resize();
}
