// What vtk.js draws: surfaces of bodies and tubes, and marks.
import vtkDataArray from '@kitware/vtk.js/Common/Core/DataArray';
import vtkPolyData from '@kitware/vtk.js/Common/DataModel/PolyData';
import vtkArrowSource from '@kitware/vtk.js/Filters/Sources/ArrowSource';
import vtkSphereSource from '@kitware/vtk.js/Filters/Sources/SphereSource';
import vtkActor from '@kitware/vtk.js/Rendering/Core/Actor';
import vtkGlyph3DMapper from '@kitware/vtk.js/Rendering/Core/Glyph3DMapper';
import vtkMapper from '@kitware/vtk.js/Rendering/Core/Mapper';
import { rgb } from './colours.js';
import { atCorners, cornerNormals, trianglesAround } from './shapes.js';

function cellsOf(triangles) {
  const cells = new Uint32Array((4 * triangles.length) / 3);
  for (let t = 0; 3 * t < triangles.length; ++t) {
    cells[4 * t] = 3;
    for (let k = 0; k < 3; ++k) cells[4 * t + 1 + k] = triangles[3 * t + k];
  }
  return cells;
}

/** A surface that is drawn, with functions that change it. */
export function makeSurface(colour, renderer, clip) {
  const data = vtkPolyData.newInstance();
  const mapper = vtkMapper.newInstance({ interpolateScalarsBeforeMapping: true, scalarVisibility: false });
  mapper.setInputData(data);
  const actor = vtkActor.newInstance();
  actor.setMapper(mapper);
  actor.getProperty().set({ ambient: 0.25, diffuse: 0.75, specular: 0, lineWidth: 1, edgeColor: [0.25, 0.25, 0.25], color: colour });
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

/** A body's surface, whose sharp edges stay sharp: each corner of a triangle is a point of its own. */
export function makeBodySurface(body, colour, renderer, clip) {
  const surface = makeSurface(colour, renderer, clip);
  const around = trianglesAround(body.triangles, body.numNodes);
  surface.setTriangles(body.triangles.map((_, corner) => corner));
  return {
    ...surface,
    setPoints: (points) => surface.setPoints(atCorners(points, body.triangles, 3), cornerNormals(points, body.triangles, around)),
    setValues: (values, colours) => surface.setValues(values ? atCorners(values, body.triangles, 1) : null, colours),
  };
}

/** Small balls at its points, or arrows where it has directions. @param size of the scene */
export function makeMark(mark, size, renderer) {
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

