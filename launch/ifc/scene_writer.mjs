// Writes the scene stream (docs/formats.md, "The scene stream") to an open file.
import { createHash } from 'node:crypto';
import { writeSync } from 'node:fs';

const record = { material: 1, mesh: 2, propertySet: 3, object: 4, instance: 5, end: 6, geoPlace: 7 };
const none = 0xffffffff;
const flushBytes = 1 << 20;

export class SceneWriter {
  #descriptor;
  #buffer = Buffer.alloc(2 * flushBytes);
  #used = 0;
  #materials = new Map();
  #meshes = new Map();
  #counts = { materials: 0, meshes: 0, propertySets: 0, objects: 0, instances: 0 };

  /** unitIsDefined: whether instances are in metres; otherwise they are in a unit that nobody named. They are y up. */
  constructor(descriptor, unitIsDefined) {
    this.#descriptor = descriptor;
    this.#bytes(Buffer.from('TRISCENE'));
    this.#u32(1);
    this.#u32(unitIsDefined ? 3 : 2);
  }

  /** The number of a display colour: red, green, blue, alpha in 0..1. */
  material(color) {
    const key = color.join(' ');
    const known = this.#materials.get(key);
    if (known !== undefined) return known;
    this.#begin(record.material, 16);
    for (const value of color) this.#f32(Number.isFinite(value) ? Math.min(Math.max(value, 0), 1) : 1);
    this.#materials.set(key, this.#counts.materials);
    return this.#counts.materials++;
  }

  /**
   * The number of a mesh: one with equal content is written once. positions: Float32Array, indices: Uint32Array;
   * parts: [[triangles, color]] in the indices' order, where they are not all of the instance's material.
   */
  mesh(name, positions, indices, parts = [[indices.length / 3, undefined]]) {
    const bytesOf = (array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength);
    const header = Uint32Array.from(parts.flatMap(([triangles, color]) => [triangles, color ? this.material(color) : none]));
    const content = [bytesOf(header), bytesOf(positions), bytesOf(indices)];
    const hash = createHash('sha1');
    for (const bytes of content) hash.update(bytes);
    const key = hash.digest('base64');
    const known = this.#meshes.get(key);
    if (known !== undefined) return known;
    const text = Buffer.from(name);
    this.#begin(record.mesh, content.reduce((sum, bytes) => sum + bytes.length, 16 + text.length));
    this.#u32(text.length);
    this.#u32(4); // bytes of a coordinate
    this.#u32(positions.length / 3);
    this.#u32(parts.length);
    this.#bytes(content[0]);
    this.#bytes(text);
    this.#bytes(content[1]);
    this.#bytes(content[2]);
    this.#meshes.set(key, this.#counts.meshes);
    return this.#counts.meshes++;
  }

  /** pairs: [[name, value]] */
  propertySet(name, pairs) {
    this.#strings(record.propertySet, [name, ...pairs.flat()], []);
    return this.#counts.propertySets++;
  }

  /** propertySets: their numbers. */
  object({ id, name, guid, type, storey, layer }, propertySets) {
    this.#strings(record.object, [id, name, guid, type, storey, layer], propertySets);
    return this.#counts.objects++;
  }

  /** transform: 16 numbers, column by column, whose last row is 0 0 0 1. */
  instance(mesh, material, object, transform) {
    this.#begin(record.instance, 12 + 96);
    this.#u32(mesh);
    this.#u32(material);
    this.#u32(object);
    for (let column = 0; column < 4; ++column) {
      for (let row = 0; row < 3; ++row) this.#f64(transform[4 * column + row]);
    }
    this.#counts.instances++;
  }

  /** Where on Earth instances are: degrees, metres, and the direction to true north, x and z of their axes. */
  geoPlace(latitude, longitude, elevation, north) {
    this.#begin(record.geoPlace, 40);
    for (const value of [latitude, longitude, elevation, ...north]) this.#f64(value);
  }

  get instances() {
    return this.#counts.instances;
  }

  end() {
    const { materials, meshes, propertySets, objects, instances } = this.#counts;
    this.#begin(record.end, 20);
    for (const count of [materials, meshes, propertySets, objects, instances]) this.#u32(count);
    this.#flush();
  }

  #strings(kind, strings, numbers) {
    const texts = strings.map((text) => Buffer.from(text ?? ''));
    const size = texts.reduce((sum, text) => sum + 4 + text.length, 8 + 4 * numbers.length);
    this.#begin(kind, size);
    this.#u32(texts.length);
    this.#u32(numbers.length);
    for (const text of texts) {
      this.#u32(text.length);
      this.#bytes(text);
    }
    for (const number of numbers) this.#u32(number);
  }

  #begin(kind, size) {
    this.#u32(kind);
    this.#room(8);
    this.#buffer.writeBigUInt64LE(BigInt(size), this.#used);
    this.#used += 8;
  }

  #u32(value) {
    this.#room(4);
    this.#used = this.#buffer.writeUInt32LE(value, this.#used);
  }

  #f32(value) {
    this.#room(4);
    this.#used = this.#buffer.writeFloatLE(value, this.#used);
  }

  #f64(value) {
    this.#room(8);
    this.#used = this.#buffer.writeDoubleLE(value, this.#used);
  }

  #bytes(bytes) {
    if (bytes.length > flushBytes) {
      this.#flush();
      writeAll(this.#descriptor, bytes);
      return;
    }
    this.#room(bytes.length);
    this.#used += bytes.copy(this.#buffer, this.#used);
  }

  #room(size) {
    if (this.#used + size > this.#buffer.length) this.#flush();
  }

  #flush() {
    writeAll(this.#descriptor, this.#buffer.subarray(0, this.#used));
    this.#used = 0;
  }
}

function writeAll(descriptor, bytes) {
  for (let at = 0; at < bytes.length;) at += writeSync(descriptor, bytes, at);
}
