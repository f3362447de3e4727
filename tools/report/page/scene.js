// The 3D scene in vtk.js: one actor for each body, one for all muscles, one for all ligaments, and marks.
import '@kitware/vtk.js/Rendering/OpenGL/Profiles/Geometry';
import '@kitware/vtk.js/Rendering/OpenGL/Profiles/Glyph';
import vtkDataArray from '@kitware/vtk.js/Common/Core/DataArray';
import vtkPlane from '@kitware/vtk.js/Common/DataModel/Plane';
import vtkPolyData from '@kitware/vtk.js/Common/DataModel/PolyData';
import vtkArrowSource from '@kitware/vtk.js/Filters/Sources/ArrowSource';
import vtkSphereSource from '@kitware/vtk.js/Filters/Sources/SphereSource';
import vtkInteractorStyleTrackballCamera from '@kitware/vtk.js/Interaction/Style/InteractorStyleTrackballCamera';
import vtkActor from '@kitware/vtk.js/Rendering/Core/Actor';
import vtkColorTransferFunction from '@kitware/vtk.js/Rendering/Core/ColorTransferFunction';
import vtkGlyph3DMapper from '@kitware/vtk.js/Rendering/Core/Glyph3DMapper';
import vtkMapper from '@kitware/vtk.js/Rendering/Core/Mapper';
import vtkRenderer from '@kitware/vtk.js/Rendering/Core/Renderer';
import vtkRenderWindow from '@kitware/vtk.js/Rendering/Core/RenderWindow';
import vtkRenderWindowInteractor from '@kitware/vtk.js/Rendering/Core/RenderWindowInteractor';
import vtkOpenGLRenderWindow from '@kitware/vtk.js/Rendering/OpenGL/RenderWindow';
import { rgb } from './colours.js';
import { boxOf, cross, firstHit, intoBody, nodeNormals, outOfBody, tubes } from './shapes.js';

const kBone = [0.89, 0.85, 0.76], kMuscle = [0.72, 0.16, 0.14], kLigament = [0.16, 0.5, 0.58];
const kTissues = ['#7fb3d5', '#e8a87c', '#9bc995', '#c5a3d9', '#e3c567', '#88c9c3'].map(rgb);
const kBlank = [0.8, 0.8, 0.8];

function cellsOf(triangles) {
  const cells = new Uint32Array((4 * triangles.length) / 3);
  for (let t = 0; 3 * t < triangles.length; ++t) {
    cells[4 * t] = 3;
    for (let k = 0; k < 3; ++k) cells[4 * t + 1 + k] = triangles[3 * t + k];
  }
  return cells;
}

/** A surface that is drawn, with functions that change it. */
function makeSurface(renderer, clip) {
  const data = vtkPolyData.newInstance();
  const mapper = vtkMapper.newInstance({ interpolateScalarsBeforeMapping: true, scalarVisibility: false });
  mapper.setInputData(data);
  const actor = vtkActor.newInstance();
  actor.setMapper(mapper);
  actor.getProperty().set({ ambient: 0.25, diffuse: 0.75, specular: 0, lineWidth: 1, edgeColor: [0.25, 0.25, 0.25] });
  renderer.addActor(actor);
  return {
    actor,
    setTriangles(triangles) { data.getPolys().setData(cellsOf(triangles)); },
    setPoints(points, normals) {
      data.getPoints().setData(points, 3);
      data.getPointData().setNormals(vtkDataArray.newInstance({ numberOfComponents: 3, values: normals, name: 'normals' }));
      data.modified();
    },
    setPose(pose) {
      const [a, b, c, x, d, e, f, y, g, h, i, z] = pose;
      actor.setUserMatrix([a, d, g, 0, b, e, h, 0, c, f, i, 0, x, y, z, 1]);
    },
    setValues(values, colours) {
      mapper.setScalarVisibility(Boolean(values));
      if (!values) return data.getPointData().setScalars(null);
      data.getPointData().setScalars(vtkDataArray.newInstance({ name: 'field', values }));
      mapper.setLookupTable(colours);
      mapper.setUseLookupTableScalarRange(true);
      return data.modified();
    },
    setClipped(clipped) {
      mapper.removeAllClippingPlanes();
      if (clipped) mapper.addClippingPlane(clip);
    },
  };
}

function addMark(mark, size, renderer) {
  const data = vtkPolyData.newInstance();
  data.getPoints().setData(mark.points, 3);
  const mapper = vtkGlyph3DMapper.newInstance({ scaling: true, scaleFactor: mark.directions ? 0.12 * size : 0.007 * size, scalarVisibility: false });
  mapper.setScaleModeToScaleByConstant();
  mapper.setInputData(data, 0);
  if (mark.directions) {
    data.getPointData().addArray(vtkDataArray.newInstance({ name: 'directions', numberOfComponents: 3, values: mark.directions }));
    mapper.setOrientationArray('directions');
    mapper.setOrientationModeToDirection();
    mapper.setInputConnection(vtkArrowSource.newInstance({ tipResolution: 16, shaftResolution: 12 }).getOutputPort(), 1);
  } else {
    mapper.setOrient(false);
    mapper.setInputConnection(vtkSphereSource.newInstance({ radius: 1, thetaResolution: 8, phiResolution: 6 }).getOutputPort(), 1);
  }
  const actor = vtkActor.newInstance();
  actor.setMapper(mapper);
  actor.getProperty().set({ color: rgb(mark.colour), ambient: 0.4, diffuse: 0.6 });
  renderer.addActor(actor);
  return actor;
}

/** @param place the element that it fills @param moved called after each change of the camera */
export function makeScene(scene, place, moved) {
  const renderer = vtkRenderer.newInstance({ background: [1, 1, 1] });
  const window = vtkRenderWindow.newInstance();
  window.addRenderer(renderer);
  const canvas = vtkOpenGLRenderWindow.newInstance();
  canvas.setContainer(place);
  window.addView(canvas);
  const interactor = vtkRenderWindowInteractor.newInstance();
  interactor.setView(canvas);
  interactor.initialize();
  interactor.bindEvents(place);
  interactor.setInteractorStyle(vtkInteractorStyleTrackballCamera.newInstance());
  const camera = renderer.getActiveCamera();
  camera.setParallelProjection(true);

  const [low, high] = boxOf(scene, 0);
  const middle = low.map((x, k) => (x + high[k]) / 2);
  const size = Math.hypot(...low.map((x, k) => high[k] - x)) || 1;
  const clip = vtkPlane.newInstance();
  const colours = vtkColorTransferFunction.newInstance({ nanColor: [...kBlank, 1] });
  colours.setNanColor(...kBlank, 1);

  const surfaces = scene.bodies.map((body, i) => {
    const surface = makeSurface(renderer, clip);
    surface.setTriangles(body.triangles);
    const tissues = scene.bodies.slice(0, i).filter(({ isTissue }) => isTissue).length;
    surface.actor.getProperty().setColor(...(body.isTissue ? kTissues[tissues % kTissues.length] : kBone));
    const points = body.points(0);
    surface.setPoints(points, nodeNormals(points, body.triangles));
    return surface;
  });
  const kinds = [['muscles', true, kMuscle], ['ligaments', false, kLigament]].map(([name, isMuscle, colour]) => {
    const lines = scene.lines.names.map((_, i) => i).filter((i) => scene.lines.isMuscle[i] === isMuscle);
    if (lines.length === 0) return null;
    const surface = makeSurface(renderer, clip);
    surface.actor.getProperty().setColor(...colour);
    return { name, lines, surface, tube: null };
  }).filter(Boolean);
  const marks = scene.marks.map((mark) => ({ name: mark.name, actor: addMark(mark, size, renderer) }));

  let [frame, field, plane] = [0, null, null];
  const isKept = (x) => !plane || plane.sign * (x[plane.axis] - plane.at) >= 0;

  function update() {
    scene.bodies.forEach((body, i) => {
      if (body.isTissue) {
        const points = body.points(frame);
        surfaces[i].setPoints(points, nodeNormals(points, body.triangles));
        surfaces[i].setValues(field ? body.values(field, frame) : null, colours);
      } else {
        surfaces[i].setPose(body.pose(frame));
      }
    });
    const paths = scene.lines.paths(frame);
    const values = field ? scene.lines.values(field, frame) : null;
    for (const kind of kinds) {
      kind.tube = tubes(kind.lines.map((i) => paths[i]), 0.004 * size);
      kind.surface.setTriangles(kind.tube.triangles);
      kind.surface.setPoints(kind.tube.points, kind.tube.normals);
      kind.surface.setValues(values ? Float32Array.from(kind.tube.ownerOfNode, (i) => values[kind.lines[i]]) : null, colours);
    }
  }

  function render() {
    window.render();
    moved({ camera, height: place.clientHeight });
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

  function resize() {
    const scale = Math.min(window.devicePixelRatio ?? globalThis.devicePixelRatio ?? 1, 2);
    canvas.setSize(Math.max(1, Math.round(place.clientWidth * scale)), Math.max(1, Math.round(place.clientHeight * scale)));
    render();
  }

  /** What lies under a place of the canvas: {name, body, value, at}, or null. What is hardly to be seen does not count. */
  function pick(x, y) {
    const [width, height] = canvas.getSize();
    const [h, v] = [(x / place.clientWidth) * width, (1 - y / place.clientHeight) * height];
    const [near, far] = [0, 1].map((z) => canvas.displayToWorld(h, v, z, renderer));
    const direction = near.map((a, k) => far[k] - a);
    const hits = [];
    const add = (surface, points, triangles, pose, tell) => {
      const property = surface.actor.getProperty();
      if (!surface.actor.getVisibility() || property.getOpacity() < 0.05) return;
      const hit = firstHit(intoBody(pose, near, 1), intoBody(pose, direction, 0), points, triangles, (p) => isKept(outOfBody(pose, p)));
      if (hit) hits.push({ ...tell(hit), distance: hit.distance, isSolid: property.getOpacity() > 0.5, at: near.map((a, k) => a + hit.distance * direction[k]) });
    };
    scene.bodies.forEach((body, i) => add(surfaces[i], body.points(frame), body.triangles, body.pose(frame), ({ triangle, weights }) => {
      const values = field ? body.values(field, frame) : null;
      return { name: body.name, body, value: values ? weights.reduce((sum, w, k) => sum + w * values[body.triangles[3 * triangle + k]], 0) : null };
    }));
    for (const kind of kinds) {
      add(kind.surface, kind.tube.points, kind.tube.triangles, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0], ({ triangle }) => {
        const line = kind.lines[kind.tube.owner[triangle]];
        return { name: `${scene.lines.names[line]} (${kind.name.slice(0, -1)})`, body: null, value: field ? scene.lines.values(field, frame)?.[line] : null };
      });
    }
    hits.sort((a, b) => b.isSolid - a.isSolid || a.distance - b.distance);
    return hits[0] ?? null;
  }

  const parts = [
    ...scene.bodies.map((body, i) => ({ name: body.name, isBone: !body.isTissue, surfaces: [surfaces[i].actor] })),
    ...kinds.map(({ name, surface }) => ({ name, isBone: false, surfaces: [surface.actor] })),
    ...marks.map(({ name, actor }) => ({ name, isBone: false, isMark: true, surfaces: [actor] })),
  ];
  const allSurfaces = [...surfaces, ...kinds.map(({ surface }) => surface)];

  interactor.onAnimation(() => moved({ camera, height: place.clientHeight }));
  new ResizeObserver(resize).observe(place);
  update();

  return {
    parts, box: [low, high], render, resize, lookFrom, pick,
    setFrame(next) { frame = next; update(); },
    setField(name) { field = name; update(); },
    setColours(stops, lowest, highest) {
      colours.removeAllPoints();
      stops.forEach((stop, i) => colours.addRGBPoint(lowest + ((highest - lowest) * i) / (stops.length - 1), ...rgb(stop)));
      colours.setMappingRange(lowest, highest);
    },
    setClip(next) {
      plane = next;
      if (plane) {
        clip.setOrigin(...[0, 1, 2].map((k) => (k === plane.axis ? plane.at : 0)));
        clip.setNormal(...[0, 1, 2].map((k) => (k === plane.axis ? plane.sign : 0)));
      }
      for (const surface of allSurfaces) surface.setClipped(Boolean(plane));
    },
    setLook({ isShaded, hasEdges }) {
      for (const surface of allSurfaces) surface.actor.getProperty().set({ lighting: isShaded, edgeVisibility: hasEdges });
    },
  };
}
