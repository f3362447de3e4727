// Undoes tools/report/packed_numbers.hpp.

async function bytesOf(base64) {
  const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Low bytes of all numbers, then the next higher ones, ... as bytes of one number after another. */
function joined(planes, size) {
  const count = planes.length / size;
  const bytes = new Uint8Array(planes.length);
  for (let which = 0; which < size; ++which)
    for (let i = 0; i < count; ++i) bytes[i * size + which] = planes[which * count + i];
  return bytes.buffer;
}

function summed(numbers, back) {
  if (back > 0) for (let i = back; i < numbers.length; ++i) numbers[i] += numbers[i - back];
  return numbers;
}

export async function unpackIntegers(packed, back) {
  return summed(new Uint32Array(joined(await bytesOf(packed), 4)), back);
}

export async function unpackDoubles(packed) {
  return new Float64Array(joined(await bytesOf(packed), 8));
}

/** Steps between low and high; 65535 is no number. */
export async function unpackQuantised({ low, high, packed }, frameSize) {
  const steps = summed(new Uint16Array(joined(await bytesOf(packed), 2)), frameSize);
  const values = new Float32Array(steps.length);
  for (let i = 0; i < steps.length; ++i) values[i] = steps[i] === 65535 ? NaN : low + (steps[i] * (high - low)) / 65534;
  return values;
}
