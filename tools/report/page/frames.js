// The 3D scene as numbers: what is where in which frame.
import { noMotion } from './shapes.js';
import { unpackDoubles, unpackIntegers, unpackQuantised } from './unpack.js';

async function unpackFields(packed, frameSize) {
  const entries = Object.entries(packed).map(async ([name, values]) => [name, await unpackQuantised(values, frameSize)]);
  return Object.fromEntries(await Promise.all(entries));
}

/** x of all nodes, y, z -> x y z x y z. */
function interleaved(planes, first, count) {
  const points = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) for (let k = 0; k < 3; ++k) points[3 * i + k] = planes[first + k * count + i];
  return points;
}

/** Nodes of tissue move, and a bone moves as a whole: pose() has three rows of rotation and translation. */
async function unpackBody(packed) {
  const isTissue = packed.kind === 'tissue';
  const triangles = await unpackIntegers(packed.triangles, 1);
  const count = triangles.reduce((most, node) => Math.max(most, node), 0) + 1;
  const planes = await unpackQuantised(packed.points, isTissue ? 3 * count : 0);
  const poses = isTissue ? [] : await unpackDoubles(packed.poses);
  const fields = await unpackFields(packed.fields, count);
  const still = isTissue ? null : interleaved(planes, 0, count);
  return {
    name: packed.name, isTissue, details: packed.details ?? [], triangles, fields, numNodes: count,
    points: (frame) => still ?? interleaved(planes, 3 * count * frame, count),
    pose: (frame) => (poses.length > 12 * frame ? poses.slice(12 * frame, 12 * frame + 12) : noMotion),
    values: (field, frame) => fields[field]?.subarray(count * frame, count * (frame + 1)),
  };
}

async function unpackLines(packed) {
  const size = packed.names.length;
  const counts = await unpackIntegers(packed.counts, size);
  const points = await unpackQuantised(packed.points, 0);
  const fields = await unpackFields(packed.fields, size);
  const begin = [0];
  for (const count of counts) begin.push(begin.at(-1) + count);
  return {
    names: packed.names, isMuscle: packed.is_muscle, size,
    paths: (frame) => Array.from({ length: size }, (_, i) => points.subarray(3 * begin[frame * size + i], 3 * begin[frame * size + i + 1])),
    values: (field, frame) => fields[field]?.subarray(size * frame, size * (frame + 1)),
    fields,
  };
}

async function unpackMark(packed) {
  return {
    ...packed, points: await unpackQuantised(packed.points, 0),
    directions: packed.directions ? await unpackQuantised(packed.directions, 0) : null,
  };
}

export async function unpackScene(packed) {
  return {
    ...packed,
    bodies: await Promise.all(packed.bodies.map(unpackBody)),
    lines: await unpackLines(packed.lines),
    marks: await Promise.all((packed.marks ?? []).map(unpackMark)),
  };
}
