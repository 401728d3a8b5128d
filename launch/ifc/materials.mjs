// Materials of types, which web-ifc does not hand on to the products of the type.
import { reference, references } from './model.mjs';

/** What the action gives; nothing where an entity is damaged. */
function attempt(action) {
  try {
    return action();
  } catch {
    return undefined;
  }
}

/** type to the products that are of it */
function productsOfTypes(model) {
  const products = new Map();
  for (const id of model.ofType('IFCRELDEFINESBYTYPE')) {
    attempt(() => {
      const values = model.arguments(id);
      const type = reference(values[5]);
      if (!products.has(type)) products.set(type, []);
      for (const product of references(values[4])) products.get(type).push(product);
    });
  }
  return products;
}

/** Associates the material of each type with those of its products that have none of their own. Before any shape is made. */
export function handOnMaterialsOfTypes(model) {
  const associations = model.ofType('IFCRELASSOCIATESMATERIAL');
  if (associations.length === 0) return;
  const products = productsOfTypes(model);
  if (products.size === 0) return;
  const related = new Map(associations.map((id) => [id, attempt(() => references(model.arguments(id)[4])) ?? []]));
  const served = new Set([...related.values()].flat());
  for (const [id, objects] of related) {
    const more = objects.flatMap((object) => products.get(object) ?? []).filter((product) => !served.has(product));
    if (more.length === 0) continue;
    attempt(() => {
      const line = model.api.GetRawLineData(model.id, id);
      for (const product of more) {
        served.add(product);
        line.arguments[4].push({ type: 5, value: product });
      }
      model.api.WriteRawLineData(model.id, line);
    });
  }
}
