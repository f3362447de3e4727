// The 3D scene: one surface for each body, one for all muscles, one for all ligaments, and marks.
import '@kitware/vtk.js/Rendering/OpenGL/Profiles/Geometry';
import '@kitware/vtk.js/Rendering/OpenGL/Profiles/Glyph';
import vtkPlane from '@kitware/vtk.js/Common/DataModel/Plane';
import vtkInteractorStyleTrackballCamera from '@kitware/vtk.js/Interaction/Style/InteractorStyleTrackballCamera';
import vtkColorTransferFunction from '@kitware/vtk.js/Rendering/Core/ColorTransferFunction';
import vtkRenderer from '@kitware/vtk.js/Rendering/Core/Renderer';
import vtkRenderWindow from '@kitware/vtk.js/Rendering/Core/RenderWindow';
import vtkRenderWindowInteractor from '@kitware/vtk.js/Rendering/Core/RenderWindowInteractor';
import vtkOpenGLRenderWindow from '@kitware/vtk.js/Rendering/OpenGL/RenderWindow';
import { rgb } from './colours.js';
import { firstTarget } from './pick.js';
import { boxOf, cross, noMotion, tubes } from './shapes.js';
import { makeBodySurface, makeMark, makeSurface } from './surfaces.js';

const kBone = [0.89, 0.85, 0.76], kMuscle = [0.72, 0.16, 0.14], kLigament = [0.16, 0.5, 0.58];
const kTissues = ['#7fb3d5', '#e8a87c', '#9bc995', '#c5a3d9', '#e3c567', '#88c9c3'].map(rgb);

/** A canvas in the place, and a camera without perspective that follows mouse and fingers. */
function makeWindow(place) {
  const renderer = vtkRenderer.newInstance({ background: [1, 1, 1] });
  const renderWindow = vtkRenderWindow.newInstance();
  renderWindow.addRenderer(renderer);
  const canvas = vtkOpenGLRenderWindow.newInstance();
  canvas.setContainer(place);
  renderWindow.addView(canvas);
  const interactor = vtkRenderWindowInteractor.newInstance();
  interactor.setView(canvas);
  interactor.initialize();
  interactor.bindEvents(place);
  interactor.setInteractorStyle(vtkInteractorStyleTrackballCamera.newInstance());
  const camera = renderer.getActiveCamera();
  camera.setParallelProjection(true);
  return { renderer, renderWindow, canvas, interactor, camera };
}

function bodySurfaces(bodies, renderer, clip) {
  let tissues = 0;
  return bodies.map((body) => makeBodySurface(body, body.isTissue ? kTissues[tissues++ % kTissues.length] : kBone, renderer, clip));
}

/** Muscles and ligaments, each kind as one surface: {name, lines (their numbers), surface, tube}. */
function lineSurfaces(lines, renderer, clip) {
  return [['muscle', true, kMuscle], ['ligament', false, kLigament]].flatMap(([name, isMuscle, colour]) => {
    const numbers = lines.names.map((_, i) => i).filter((i) => lines.isMuscle[i] === isMuscle);
    return numbers.length > 0 ? [{ name, lines: numbers, surface: makeSurface(colour, renderer, clip), tube: null }] : [];
  });
}

/** @param place the element that it fills @param moved called after each change of what is seen */
export function makeScene(scene, place, moved) {
  const { renderer, renderWindow, canvas, interactor, camera } = makeWindow(place);
  const [low, high] = boxOf(scene, 0);
  const middle = low.map((x, k) => (x + high[k]) / 2);
  const size = Math.hypot(...low.map((x, k) => high[k] - x)) || 1;
  const clip = vtkPlane.newInstance();
  const colours = vtkColorTransferFunction.newInstance();
  colours.setNanColor(0.8, 0.8, 0.8, 1);
  const bodies = bodySurfaces(scene.bodies, renderer, clip);
  const kinds = lineSurfaces(scene.lines, renderer, clip);
  const marks = scene.marks.map((mark) => ({ name: mark.name, actor: makeMark(mark, size, renderer) }));
  const surfaces = [...bodies, ...kinds.map(({ surface }) => surface)];
  let [frame, field, plane] = [0, null, null];

  const valuesOf = (carrier) => (field ? carrier.values(field, frame) : null);

  function updateBody(body, surface) {
    if (!body.isTissue) return surface.setPose(body.pose(frame));
    surface.setPoints(body.points(frame));
    return surface.setValues(valuesOf(body), colours);
  }
  function updateKind(kind, paths, values) {
    kind.tube = tubes(kind.lines.map((i) => paths[i]), 0.004 * size);
    kind.surface.setTriangles(kind.tube.triangles);
    kind.surface.setPoints(kind.tube.points, kind.tube.normals);
    kind.surface.setValues(values ? Float32Array.from(kind.tube.ownerOfNode, (i) => values[kind.lines[i]]) : null, colours);
  }
  function update() {
    scene.bodies.forEach((body, i) => updateBody(body, bodies[i]));
    const paths = scene.lines.paths(frame);
    for (const kind of kinds) updateKind(kind, paths, valuesOf(scene.lines));
  }

  const tellMoved = () => moved({ camera, height: place.clientHeight });
  function render() {
    renderWindow.render();
    tellMoved();
  }
  function resize() {
    const scale = Math.min(devicePixelRatio, 2);
    canvas.setSize(Math.max(1, Math.round(place.clientWidth * scale)), Math.max(1, Math.round(place.clientHeight * scale)));
    render();
  }

  /** Looks at the whole scene, which fills the picture. */
  function lookFrom({ up, to_eye: toEye }) {
    camera.setFocalPoint(...middle);
    camera.setPosition(...middle.map((x, k) => x + size * toEye[k]));
    camera.setViewUp(...up);
    const half = (axis) => axis.reduce((sum, x, k) => sum + (Math.abs(x) * (high[k] - low[k])) / 2, 0);
    const aspect = place.clientWidth / place.clientHeight;
    camera.setParallelScale(1.12 * Math.max(half(up), half(cross(up, toEye)) / aspect));
    renderer.resetCameraClippingRange();
  }

  function bodyTarget(body, surface) {
    return {
      actor: surface.actor, points: body.points(frame), triangles: body.triangles, pose: body.pose(frame),
      tell({ triangle, weights }) {
        const values = valuesOf(body);
        const value = values ? weights.reduce((sum, weight, k) => sum + weight * values[body.triangles[3 * triangle + k]], 0) : null;
        return { name: body.name, details: body.details, value };
      },
    };
  }
  function kindTarget({ name, lines, surface, tube }) {
    return {
      actor: surface.actor, points: tube.points, triangles: tube.triangles, pose: noMotion,
      tell({ triangle }) {
        const line = lines[tube.owner[triangle]];
        return { name: `${scene.lines.names[line]} (${name})`, details: [], value: valuesOf(scene.lines)?.[line] ?? null };
      },
    };
  }
  /** What lies under a place of the canvas: {name, details, value, at}, or null. */
  function pick(x, y) {
    const [width, height] = canvas.getSize();
    const [h, v] = [(x / place.clientWidth) * width, (1 - y / place.clientHeight) * height];
    const [near, far] = [0, 1].map((z) => canvas.displayToWorld(h, v, z, renderer));
    const targets = [...scene.bodies.map((body, i) => bodyTarget(body, bodies[i])), ...kinds.map(kindTarget)];
    return firstTarget(near, near.map((a, k) => far[k] - a), targets, (at) => !plane || plane.sign * (at[plane.axis] - plane.at) >= 0);
  }

  scene.bodies.forEach((body, i) => bodies[i].setPoints(body.points(0)));
  update();
  interactor.onAnimation(tellMoved);
  new ResizeObserver(resize).observe(place);

  return {
    /** What can be hidden: {name, isBone, isMark, actor}. */
    parts: [
      ...scene.bodies.map((body, i) => ({ name: body.name, isBone: !body.isTissue, actor: bodies[i].actor })),
      ...kinds.map(({ name, surface }) => ({ name: `${name}s`, actor: surface.actor })),
      ...marks.map(({ name, actor }) => ({ name, isMark: true, actor })),
    ],
    box: [low, high], render, resize, lookFrom, pick,
    setFrame(next) { frame = next; update(); },
    setField(name) { field = name; update(); },
    setColours(stops, lowest, highest) {
      colours.removeAllPoints();
      stops.forEach((stop, i) => colours.addRGBPoint(lowest + ((highest - lowest) * i) / (stops.length - 1), ...rgb(stop)));
      colours.setMappingRange(lowest, highest);
    },
    /** @param next {axis, at, sign}: what is kept lies on that side; null: all */
    setClip(next) {
      plane = next;
      if (plane) {
        clip.setOrigin(...[0, 1, 2].map((k) => (k === plane.axis ? plane.at : 0)));
        clip.setNormal(...[0, 1, 2].map((k) => (k === plane.axis ? plane.sign : 0)));
      }
      for (const surface of surfaces) surface.setClipped(Boolean(plane));
    },
    setLook({ isShaded, hasEdges }) {
      for (const surface of surfaces) surface.actor.getProperty().set({ lighting: isShaded, edgeVisibility: hasEdges });
    },
  };
}
