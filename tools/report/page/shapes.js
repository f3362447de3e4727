// Triangles and what is computed of them.

/** Unit normals at the nodes: means over the faces around, by their area. */
export function nodeNormals(points, triangles) {
  const normals = new Float32Array(points.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const [ux, uy, uz] = [points[b] - points[a], points[b + 1] - points[a + 1], points[b + 2] - points[a + 2]];
    const [vx, vy, vz] = [points[c] - points[a], points[c + 1] - points[a + 1], points[c + 2] - points[a + 2]];
    const face = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const node of [a, b, c]) for (let k = 0; k < 3; ++k) normals[node + k] += face[k];
  }
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    for (let k = 0; k < 3; ++k) normals[i + k] /= length;
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
