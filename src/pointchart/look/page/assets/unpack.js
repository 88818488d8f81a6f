// The arrays of the page: base64, deflate, bytes of numbers by their rank.

const content = JSON.parse(document.getElementById("content").textContent);

async function unpack() {
  const text = atob(document.getElementById("data").textContent.trim());
  const packed = new Uint8Array(text.length);
  for (let k = 0; k < text.length; k++) packed[k] = text.charCodeAt(k);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const arrays = {};
  for (const row of content.arrays) arrays[row.name] = gathered(bytes, row);
  for (const name of ["triangles", "loop", "row"]) arrays[name] = summed(arrays[name]);
  return arrays;
}

function gathered(bytes, row) {
  const kind = { Uint16: Uint16Array, Uint32: Uint32Array, Float32: Float32Array }[row.type];
  const size = kind.BYTES_PER_ELEMENT, whole = new Uint8Array(row.length * size);
  for (let rank = 0; rank < size; rank++) {
    const begin = row.offset + rank * row.length;
    for (let k = 0; k < row.length; k++) whole[k * size + rank] = bytes[begin + k];
  }
  return new kind(whole.buffer);
}

function summed(steps) {
  const indices = new Uint32Array(steps.length);
  let index = 0;
  for (let k = 0; k < steps.length; k++) {
    index += steps[k] % 2 ? -(steps[k] + 1) / 2 : steps[k] / 2;
    indices[k] = index;
  }
  return indices;
}
