// The arrays of whole numbers that tools/html/blob.cc packs.

async function inflate(base64) {
  const text = atob(base64.trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Numbers whose bytes lie in planes, the lowest first. */
function fromPlanes(bytes, count, width) {
  const numbers = new Uint32Array(count);
  for (let k = 0; k < width; ++k)
    for (let i = 0; i < count; ++i) numbers[i] |= bytes[k * count + i] << (8 * k);
  return numbers;
}

const undo = {
  value() {},
  difference(numbers, stride) {
    for (let i = 0; i < numbers.length; ++i) {
      const folded = numbers[i];
      const difference = (folded >>> 1) ^ -(folded & 1);
      numbers[i] = difference + (i < stride ? 0 : numbers[i - stride]);
    }
  },
  first_use(numbers) {
    let next = 0;
    for (let i = 0; i < numbers.length; ++i) {
      numbers[i] = next - numbers[i];
      if (numbers[i] === next) ++next;
    }
  },
};

/** The arrays by name; `contents` tells what lies where. */
export async function readArrays(base64, contents) {
  const bytes = await inflate(base64);
  const arrays = {};
  let place = 0;
  for (const [name, {count, width, by, stride}] of Object.entries(contents)) {
    arrays[name] = fromPlanes(bytes.subarray(place, place + count * width), count, width);
    undo[by](arrays[name], stride);
    place += count * width;
  }
  return arrays;
}
