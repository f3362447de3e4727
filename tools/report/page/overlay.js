// What lies over the 3D view: axes with their words, and a scale bar.
import { element } from './elements.js';
import { cross } from './shapes.js';

const kSvg = 'http://www.w3.org/2000/svg';
const kAxisColours = ['#b3261e', '#1b7a3d', '#1f4fa3'];

function svg(tag, attributes, text = '') {
  const node = document.createElementNS(kSvg, tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.textContent = text;
  return node;
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** 1, 2 or 5 times a power of ten, at most `most`. */
function roundLength(most) {
  const power = 10 ** Math.floor(Math.log10(most));
  return ([5, 2].find((digit) => digit * power <= most) ?? 1) * power;
}

/** @return {node, show(camera)} */
export function makeOverlay({ directions, length_unit: unit }) {
  const axes = svg('svg', { viewBox: '-70 -50 140 100', class: 'axes', 'aria-label': 'directions' });
  const bar = element('div', { className: 'scale-bar' });
  const labels = ['x', 'y', 'z'].map((letter, k) => directions[k] || letter);

  function showAxes(camera) {
    const toEye = camera.getDirectionOfProjection().map((x) => -x);
    const up = camera.getViewUp();
    const right = cross(up, toEye);
    const above = cross(toEye, right);
    const order = [0, 1, 2].sort((a, b) => toEye[a] - toEye[b]);  // the nearest is drawn last
    axes.replaceChildren(...order.flatMap((k) => {
      const axis = [0, 1, 2].map((i) => Number(i === k));
      const [x, y] = [30 * dot(axis, right), -30 * dot(axis, above)];
      return [
        svg('line', { x1: 0, y1: 0, x2: x, y2: y, stroke: kAxisColours[k], 'stroke-width': 2.5 }),
        svg('text', { x: 1.3 * x, y: 1.3 * y, fill: kAxisColours[k], 'text-anchor': x < -8 ? 'end' : x > 8 ? 'start' : 'middle', 'dominant-baseline': 'middle' }, labels[k]),
      ];
    }));
  }

  function showScale(camera, height) {
    const perPixel = (2 * camera.getParallelScale()) / height;
    const length = roundLength(110 * perPixel);
    bar.style.width = `${length / perPixel}px`;
    bar.textContent = `${length} ${unit}`;
  }

  return {
    nodes: [axes, bar],
    show({ camera, height }) {
      showAxes(camera);
      showScale(camera, height);
    },
  };
}
