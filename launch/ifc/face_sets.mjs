// What web-ifc passes over in the face sets of IFC4: a colour for each face, and points by another list's numbers.
import { reference } from './model.mjs';

/** Whether it came to its end: a damaged entity is drawn as if it were not there. */
function attempt(action) {
  try {
    action();
    return true;
  } catch {
    return false;
  }
}

/** The colours of triangulated face sets with one for each face: number of the set to [red, green, blue] per triangle. */
export function faceColors(model) {
  const colors = new Map();
  const add = (id) => {
    const [set, opacity, list, indices] = model.arguments(id);
    const palette = model.arguments(reference(list))[0].map((color) => color.map((component) => Number(component.value)));
    const alpha = Number(opacity?.value ?? 1);
    colors.set(reference(set), indices.map((index) => [...palette[Number(index.value) - 1], alpha]));
  };
  for (const id of model.ofType('IFCINDEXEDCOLOURMAP')) attempt(() => add(id));
  return colors;
}

/** Writes the numbers of points that triangles mean (PnIndex) into the triangles. Gives how many sets are left with such. */
export function resolvePointNumbers(model) {
  const renumber = (id) => {
    const line = model.api.GetRawLineData(model.id, id);
    const [, , , triangles, numbers] = line.arguments;
    for (const triangle of triangles) {
      for (const index of triangle) index.value = Number(numbers[Number(index.value) - 1].value);
    }
    line.arguments[4] = null;
    model.api.WriteRawLineData(model.id, line);
  };
  const haveNumbers = (type, at) => model.ofType(type).filter((id) => model.arguments(id)[at]?.length > 0);
  const triangulated = haveNumbers('IFCTRIANGULATEDFACESET', 4).filter((id) => !attempt(() => renumber(id)));
  return triangulated.length + haveNumbers('IFCPOLYGONALFACESET', 3).length;
}

/** Parts of one colour each: indices in their order, and [[triangles, color]]. */
export function partsByColor(indices, colors) {
  const groups = new Map();
  colors.forEach((color, triangle) => {
    const key = color.join(' ');
    if (!groups.has(key)) groups.set(key, { color, triangles: [] });
    groups.get(key).triangles.push(triangle);
  });
  const ordered = new Uint32Array(indices.length);
  let at = 0;
  const parts = [];
  for (const { color, triangles } of groups.values()) {
    for (const triangle of triangles) {
      ordered.set(indices.subarray(3 * triangle, 3 * triangle + 3), at);
      at += 3;
    }
    parts.push([triangles.length, color]);
  }
  return { indices: ordered, parts };
}
