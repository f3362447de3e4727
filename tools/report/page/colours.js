// Which colours stand for which values.

const kNames = { von_mises: 'von Mises stress', force: 'tension of lines', length: 'length of lines', activation: 'muscle activation' };
export const fieldTitle = (name) => kNames[name] ?? name.replaceAll('_', ' ');

/** The largest 99.5th percentile of |value - rest| of a frame: the few values above it hide all others. */
function reach(columns, rest, frames) {
  let most = 0;
  for (const values of columns) {
    const size = values.length / frames;
    for (let frame = 0; frame < frames; ++frame) {
      const sizes = values.subarray(size * frame, size * (frame + 1)).map((value) => Math.abs(value - rest)).filter((value) => !Number.isNaN(value)).sort();
      if (sizes.length > 0) most = Math.max(most, sizes[Math.min(sizes.length - 1, Math.floor(0.995 * sizes.length))]);
    }
  }
  return most;
}

/** {low, high, map}: from rest upwards, or to both sides of it. In the unit of the files. */
export function naturalRange(field, scene) {
  const frames = scene.moments.length;
  const carriers = field.is_of_lines ? [scene.lines] : scene.bodies;
  const columns = carriers.map((carrier) => carrier.fields[field.name]).filter(Boolean);
  const far = reach(columns, field.rest, frames) || 1e-9;
  const goesBelow = columns.some((values) => values.some((value) => value < field.rest - 0.02 * far));
  return goesBelow || field.rest !== 0
    ? { low: field.rest - far, high: field.rest + far, map: 'blue-red' }
    : { low: 0, high: far, map: 'viridis' };
}

export const rgb = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);
