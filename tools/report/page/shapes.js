// Triangles and what is computed of them.

/** For each node the triangles around it: those of node i are list[begin[i]] to list[begin[i + 1]] (excluded). */
export function trianglesAround(triangles, numNodes) {
  const begin = new Uint32Array(numNodes + 2);
  for (const node of triangles) ++begin[node + 2];
  for (let i = 2; i < begin.length; ++i) begin[i] += begin[i - 1];
  const list = new Uint32Array(triangles.length);
  triangles.forEach((node, corner) => { list[begin[node + 1]++] = Math.floor(corner / 3); });
  return { begin, list };
}

/** What belongs to nodes, for each corner of each triangle. @param size numbers of a node */
export function atCorners(values, triangles, size) {
  const spread = new Float32Array(size * triangles.length);
  for (let corner = 0; corner < triangles.length; ++corner)
    for (let k = 0; k < size; ++k) spread[size * corner + k] = values[size * triangles[corner] + k];
  return spread;
}

const kSharp = Math.cos((45 * Math.PI) / 180);

/** Unit normals at the corners of triangles: of the faces around by their area, but not across a sharp edge. */
export function cornerNormals(points, triangles, { begin, list }) {
  const faces = new Float32Array(triangles.length), areas = new Float32Array(triangles.length / 3);
  for (let t = 0; t < areas.length; ++t) {
    const [a, b, c] = [3 * triangles[3 * t], 3 * triangles[3 * t + 1], 3 * triangles[3 * t + 2]];
    const ux = points[b] - points[a], uy = points[b + 1] - points[a + 1], uz = points[b + 2] - points[a + 2];
    const vx = points[c] - points[a], vy = points[c + 1] - points[a + 1], vz = points[c + 2] - points[a + 2];
    faces[3 * t] = uy * vz - uz * vy;
    faces[3 * t + 1] = uz * vx - ux * vz;
    faces[3 * t + 2] = ux * vy - uy * vx;
    areas[t] = Math.hypot(faces[3 * t], faces[3 * t + 1], faces[3 * t + 2]);
  }
  const normals = new Float32Array(3 * triangles.length);
  for (let corner = 0; corner < triangles.length; ++corner) {
    const own = Math.floor(corner / 3), node = triangles[corner];
    let x = 0, y = 0, z = 0;
    for (let i = begin[node]; i < begin[node + 1]; ++i) {
      const other = list[i];
      const dot = faces[3 * own] * faces[3 * other] + faces[3 * own + 1] * faces[3 * other + 1] + faces[3 * own + 2] * faces[3 * other + 2];
      if (dot < kSharp * areas[own] * areas[other]) continue;
      x += faces[3 * other];
      y += faces[3 * other + 1];
      z += faces[3 * other + 2];
    }
    const length = Math.hypot(x, y, z) || 1;
    normals.set([x / length, y / length, z / length], 3 * corner);
  }
  return normals;
}

export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => { const length = Math.hypot(...a) || 1; return a.map((x) => x / length); };

const kSides = 8;

/** Round tubes along paths. `owner` names the path of each triangle. */
export function tubes(paths, radius) {
  const points = [], normals = [], triangles = [], owner = [], ownerOfNode = [];
  paths.forEach((path, line) => {
    const count = path.length / 3;
    const at = (i) => path.subarray(3 * i, 3 * i + 3);
    let side = null;
    for (let i = 0; i < count; ++i) {
      const [before, after] = [at(Math.max(i - 1, 0)), at(Math.min(i + 1, count - 1))];
      const along = unit([0, 1, 2].map((k) => after[k] - before[k]));
      // As little twist from ring to ring as there can be.
      const guess = side ?? (Math.abs(along[0]) < 0.8 ? [1, 0, 0] : [0, 1, 0]);
      const other = unit(cross(along, guess));
      side = cross(other, along);
      const first = points.length / 3;
      for (let s = 0; s < kSides; ++s) {
        const [cos, sin] = [Math.cos((2 * Math.PI * s) / kSides), Math.sin((2 * Math.PI * s) / kSides)];
        for (let k = 0; k < 3; ++k) {
          const normal = cos * side[k] + sin * other[k];
          normals.push(normal);
          points.push(at(i)[k] + radius * normal);
        }
        ownerOfNode.push(line);
        if (i + 1 === count) continue;
        const [a, b] = [first + s, first + ((s + 1) % kSides)];
        triangles.push(a, b, b + kSides, a, b + kSides, a + kSides);
        owner.push(line, line);
      }
    }
  });
  return {
    points: Float32Array.from(points), normals: Float32Array.from(normals),
    triangles: Uint32Array.from(triangles), owner, ownerOfNode,
  };
}

/** Where a ray first meets triangles: {distance, triangle, weights}, or null. @param counts(point): whether a hit there counts */
export function firstHit(origin, direction, points, triangles, counts) {
  let best = null;
  const e1 = [0, 0, 0], e2 = [0, 0, 0], s = [0, 0, 0];
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    for (let k = 0; k < 3; ++k) {
      e1[k] = points[b + k] - points[a + k];
      e2[k] = points[c + k] - points[a + k];
      s[k] = origin[k] - points[a + k];
    }
    const p = cross(direction, e2);
    const determinant = e1[0] * p[0] + e1[1] * p[1] + e1[2] * p[2];
    if (determinant === 0) continue;
    const u = (s[0] * p[0] + s[1] * p[1] + s[2] * p[2]) / determinant;
    if (u < 0 || u > 1) continue;
    const q = cross(s, e1);
    const v = (direction[0] * q[0] + direction[1] * q[1] + direction[2] * q[2]) / determinant;
    if (v < 0 || u + v > 1) continue;
    const distance = (e2[0] * q[0] + e2[1] * q[1] + e2[2] * q[2]) / determinant;
    if (distance < 0 || (best && distance >= best.distance)) continue;
    if (!counts([0, 1, 2].map((k) => origin[k] + distance * direction[k]))) continue;
    best = { distance, triangle: t / 3, weights: [1 - u - v, u, v] };
  }
  return best;
}

/** A pose: three rows of rotation and translation. */
export const noMotion = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

/** Inverse of a rigid pose, on a point (w = 1) or a direction (w = 0). */
export function intoBody(pose, x, w) {
  const shifted = [0, 1, 2].map((k) => x[k] - w * pose[4 * k + 3]);
  return [0, 1, 2].map((k) => shifted[0] * pose[k] + shifted[1] * pose[4 + k] + shifted[2] * pose[8 + k]);
}

export function outOfBody(pose, x) {
  return [0, 1, 2].map((k) => pose[4 * k] * x[0] + pose[4 * k + 1] * x[1] + pose[4 * k + 2] * x[2] + pose[4 * k + 3]);
}

/** [low, high] of all points of all bodies in a frame, and of lines. */
export function boxOf(scene, frame) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  const add = (x) => { for (let k = 0; k < 3; ++k) { low[k] = Math.min(low[k], x[k]); high[k] = Math.max(high[k], x[k]); } };
  for (const body of scene.bodies) {
    const [points, pose] = [body.points(frame), body.pose(frame)];
    for (let i = 0; i < points.length; i += 3) add(outOfBody(pose, points.subarray(i, i + 3)));
  }
  for (const path of scene.lines.paths(frame)) for (let i = 0; i < path.length; i += 3) add(path.subarray(i, i + 3));
  return [low, high];
}
