// Reads an IFC file with web-ifc and writes it to descriptor 3 as a scene stream (docs/formats.md): run by
// triptych-import-ifc, which gives the file and the products to skip, and reads descriptor 5. "warning: ...", "progress: DONE TOTAL" and at most one "triptych: ..." go to standard error.
import { readFileSync, writeSync } from 'node:fs';
import { IfcModel, Messages, reference, references, text } from './model.mjs';
import { faceColors, partsByColor, resolvePointNumbers } from './face_sets.mjs';
import { geoPlace } from './geo_place.mjs';
import { handOnMaterialsOfTypes } from './materials.mjs';
import { Objects } from './objects.mjs';
import { openIfc } from './open_ifc.mjs';
import { SceneWriter } from './scene_writer.mjs';
import { weld } from './weld.mjs';

/** Products that are there to be cut out, walked through or counted, not to be looked at. */
const notDrawn = ['IFCFEATUREELEMENTSUBTRACTION', 'IFCOPENINGELEMENT', 'IFCSPACE', 'IFCSPATIALZONE',
  'IFCEXTERNALSPATIALSTRUCTUREELEMENT', 'IFCVIRTUALELEMENT', 'IFCGRID', 'IFCANNOTATION', 'IFCPORT',
  'IFCSTRUCTURALACTIVITY', 'IFCSTRUCTURALITEM'];
/** Representations that are not the product's body. */
const notBody = ['Axis', 'Box', 'FootPrint', 'Annotation', 'Reference', 'Clearance', 'CoG', 'Lighting', 'Profile', 'Plan'];
const namedFailures = 5;

function say(line) {
  writeSync(2, `${line}\n`);
}

function short(message) {
  return String(message).replace(/\s+/g, ' ').slice(0, 160);
}

/** Whether next to nothing is left of what the process may take: web-ifc's exceptions do not say their reason. */
function memoryIsShort() {
  const limit = /Max data size\s+(\d+)/.exec(readFileSync('/proc/self/limits', 'utf8'));
  const used = /VmData:\s+(\d+)/.exec(readFileSync('/proc/self/status', 'utf8'));
  return limit !== null && used !== null && 1024 * Number(used[1]) > 0.8 * Number(limit[1]);
}

function outOfMemory(error) {
  return /out of memory|enlarge memory|bad_alloc|allocation failed/i.test(String(error?.message)) || memoryIsShort();
}

function complaint(error) {
  if (outOfMemory(error)) return 'needs more memory to read than it is given';
  if (error instanceof WebAssembly.Exception) return 'web-ifc cannot read it; it is damaged or not IFC';
  const ours = error?.constructor === Error;  // others are thrown by the language, where web-ifc gives what no IFC file would
  return ours ? short(error.message) : `is damaged or no IFC file; web-ifc fails with: ${short(error?.message ?? error)}`;
}

/** The product's kind and what describes its body. */
function describe(model, id) {
  const values = model.arguments(id);
  const product = { type: model.typeName(model.api.GetLineType(model.id, id)), values, representations: [] };
  const shape = reference(values[6]);
  if (shape === undefined) return product;
  for (const representation of references(model.arguments(shape)[2])) {
    const parts = model.arguments(representation);
    if (!notBody.includes(text(parts[1]))) product.representations.push({ id: representation, items: references(parts[3]) });
  }
  return product;
}

/** Whether the file names a unit of length. */
function unitIsDefined(model) {
  for (const assignment of model.ofType('IFCUNITASSIGNMENT')) {
    for (const unit of references(model.arguments(assignment)[0])) {
      if (model.arguments(unit).some((argument) => text(argument) === 'LENGTHUNIT')) return true;
    }
  }
  return false;
}

/** Counts what a product could not give, by kind, with the first few numbers. */
class Failures {
  #kinds = new Map();

  add(what, type, id) {
    const key = `${what}\n${type}`;
    if (!this.#kinds.has(key)) this.#kinds.set(key, []);
    this.#kinds.get(key).push(id);
  }

  report() {
    for (const [key, ids] of this.#kinds) {
      const [what, type] = key.split('\n');
      const first = ids.slice(0, namedFailures).map((id) => `#${id}`).join(', ');
      say(`warning: ${ids.length} ${type} ${what}: ${first}${ids.length > namedFailures ? ' ...' : ''}`);
    }
  }
}

/** colors: as of faceColors(); object: gives the product's number and name, once it is known to be drawn. */
function writeMesh(model, writer, colors, mesh, object) {
  const { api } = model;
  for (let i = 0; i < mesh.geometries.size(); ++i) {
    const placed = mesh.geometries.get(i);
    const geometry = api.GetGeometry(model.id, placed.geometryExpressID);
    const vertices = api.GetVertexArray(geometry.GetVertexData(), geometry.GetVertexDataSize());
    const indices = api.GetIndexArray(geometry.GetIndexData(), geometry.GetIndexDataSize());
    if (indices.length >= 3) {
      const welded = weld(vertices, indices);
      const perFace = colors.get(placed.geometryExpressID);
      const { x, y, z, w } = placed.color;
      const { number, name } = object();
      let shape = { indices: welded.indices };
      if (perFace?.length === indices.length / 3) shape = partsByColor(welded.indices, perFace);
      writer.instance(writer.mesh(name, welded.positions, shape.indices, shape.parts), writer.material([x, y, z, w]), number,
        placed.flatTransformation);
    }
    geometry.delete();
  }
}

class Progress {
  #next = Date.now() + 200;

  at(done, total) {
    if (Date.now() < this.#next) return;
    this.#next = Date.now() + 200;
    say(`progress: ${done} ${total}`);
  }
}

/** web-ifc's y points up, and its z to where the file's y does not. */
function writePlace(model, writer) {
  const place = geoPlace(model);
  if (place?.wrong) return say(`warning: the site ${place.wrong} lies nowhere on Earth, which was not read`);
  if (place) writer.geoPlace(place.latitude, place.longitude, place.elevation, [place.north[0], -place.north[1]]);
}

/** Tells triptych-import-ifc which product is being read; 0: none. */
function reading(id) {
  const word = Buffer.alloc(4);
  word.writeUInt32LE(id);
  writeSync(5, word, 0, 4, 0);
}

/** skipped: products that made an earlier run crash or hang. */
async function convert(path, skipped) {
  const messages = new Messages();
  const model = await IfcModel.open(openIfc(path), messages);
  const writer = new SceneWriter(3, unitIsDefined(model));
  writePlace(model, writer);
  const left = new Set(model.ofType('IFCPRODUCT'));
  const undrawn = new Map();
  for (const type of notDrawn) {
    for (const id of model.ofType(type)) {
      if (left.delete(id)) undrawn.set(type, (undrawn.get(type) ?? 0) + 1);
    }
  }
  const objects = new Objects(model, writer);
  const colors = faceColors(model);
  const unresolved = resolvePointNumbers(model);
  handOnMaterialsOfTypes(model);
  if (unresolved > 0) say(`warning: ${unresolved} face sets number their points by another list (PnIndex), which was not followed`);
  const failures = new Failures();
  const progress = new Progress();
  let done = 0;
  for (const id of left) {
    progress.at(done++, left.size);
    let type = 'product';
    const before = writer.instances;
    try {
      type = model.typeName(model.api.GetLineType(model.id, id));
      if (skipped.has(id)) {
        failures.add('made web-ifc crash or hang and were left out', type, id);
        continue;
      }
      reading(id);
      const product = describe(model, id);
      let object;
      model.api.StreamMeshes(model.id, [id], (mesh) => writeMesh(model, writer, colors, mesh, () => (object ??= objects.write(id, product))));
      if (writer.instances === before && product.representations.some((body) => body.items.length > 0))
        failures.add('have a body of which web-ifc made no triangles', type, id);
    } catch (error) {
      if (outOfMemory(error)) throw error;
      failures.add(writer.instances === before ? 'made web-ifc fail and were left out' : 'made web-ifc fail and are not whole', type, id);
      if (error instanceof WebAssembly.RuntimeError || error instanceof RangeError) {
        await model.openAgain();
        resolvePointNumbers(model);
        handOnMaterialsOfTypes(model);
      }
    } finally {
      reading(0);
    }
  }
  failures.report();
  for (const [what, count] of [...messages.counts].slice(0, 10)) say(`warning: web-ifc: ${short(what)}${count > 1 ? ` (${count} times)` : ''}`);
  if (writer.instances === 0) {
    for (const [type, count] of undrawn) say(`warning: ${count} ${type} are not drawn`);
  }
  writer.end();
}

try {
  await convert(process.argv[2], new Set(process.argv.slice(3).map(Number)));
  process.exit(0);
} catch (error) {
  say(`triptych: ${complaint(error)}`);
  process.exit(1);
}
