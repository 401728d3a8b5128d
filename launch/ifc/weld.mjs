// From web-ifc's vertices (position and normal each, one for every corner of a face) to positions that are shared.

let table = new Int32Array(0);

/** Vertices: Float32Array of six numbers each; indices: Uint32Array. Positions that are equal become one. */
export function weld(vertices, indices) {
  const count = vertices.length / 6;
  let size = 16;
  while (size < 2 * count) size *= 2;
  if (table.length < size) table = new Int32Array(size);
  const slots = table.subarray(0, size).fill(-1);
  const positions = new Float32Array(3 * count);
  const bits = new Uint32Array(positions.buffer);
  const renamed = new Uint32Array(count);
  let kept = 0;
  for (let i = 0; i < count; ++i) {
    const at = 3 * kept;
    for (let k = 0; k < 3; ++k) positions[at + k] = vertices[6 * i + k] + 0; // -0 becomes 0
    let slot = Math.imul(bits[at], 0x9e3779b1) ^ Math.imul(bits[at + 1], 0x85ebca6b) ^ Math.imul(bits[at + 2], 0xc2b2ae35);
    slot = (slot ^ (slot >>> 15)) & (size - 1);
    for (; slots[slot] >= 0; slot = (slot + 1) & (size - 1)) {
      const other = 3 * slots[slot];
      if (bits[other] === bits[at] && bits[other + 1] === bits[at + 1] && bits[other + 2] === bits[at + 2]) break;
    }
    if (slots[slot] < 0) slots[slot] = kept++;
    renamed[i] = slots[slot];
  }
  return { positions: positions.slice(0, 3 * kept), indices: Uint32Array.from(indices, (index) => renamed[index]) };
}
