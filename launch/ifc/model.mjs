// An IFC file that web-ifc has open, with a reader that starts again where web-ifc fell over a part of it.
import { createRequire } from 'node:module';

/** What web-ifc prints: each message once, with its count. */
export class Messages {
  #counts = new Map();

  add(text) {
    // "[2026-01-01 00:00:00.000] [error] [GetMesh()] what"
    const what = text.replace(/^(\[[^\]]*\]\s*)+/, '').replace(/\s+/g, ' ').trim();
    if (what === '' || (this.#counts.size >= 100 && !this.#counts.has(what))) return;
    this.#counts.set(what, (this.#counts.get(what) ?? 0) + 1);
  }

  get counts() {
    return this.#counts;
  }
}

/** From here on whatever is printed is a message. */
function listen(messages) {
  const add = (...words) => messages.add(words.map(String).join(' '));
  for (const name of ['log', 'info', 'warn', 'error', 'debug']) console[name] = add;
}

export class IfcModel {
  #file;
  #messages;
  #library;

  /** file: as of openIfc(). */
  static async open(file, messages) {
    listen(messages);
    const model = new IfcModel();
    model.#file = file;
    model.#messages = messages;
    model.#library = createRequire(import.meta.url)('web-ifc');
    await model.openAgain();
    return model;
  }

  /** A new web-ifc with the same file: after a failure the old one's memory cannot be relied on. */
  async openAgain() {
    this.api = new this.#library.IfcAPI();
    await this.api.Init();
    this.api.SetLogLevel(this.#library.LogLevel.LOG_LEVEL_ERROR);
    this.id = this.api.OpenModelFromCallback(this.#file.read, {
      COORDINATE_TO_ORIGIN: false,
      CIRCLE_SEGMENTS: 24,
      ALLOW_INCOMPATIBLE_SCHEMA_ALIASES: true,
    });
    if (this.id >= 0) return;
    const said = [...this.#messages.counts.keys()].at(-1);
    throw new Error(`is damaged or no IFC file${said ? `; web-ifc says: ${said}` : ''}`);
  }

  code(typeName) {
    return this.api.GetTypeCodeFromName(typeName);
  }

  typeName(code) {
    return this.api.GetNameFromTypeCode(code);
  }

  /** The numbers of all entities of a type, subtypes included, in rising order; empty for a type that the schema lacks. */
  ofType(typeName) {
    const found = this.api.GetLineIDsWithType(this.id, this.code(typeName), true);
    const ids = [];
    for (let i = 0; i < found.size(); ++i) ids.push(found.get(i));
    found.delete?.();
    return ids.sort((a, b) => a - b);
  }

  /** Its arguments as the file has them: { type, value }, null, or an array of them; none of an entity that is not there. */
  arguments(id) {
    return (this.api.GetLineType(this.id, id) && this.api.GetRawLineData(this.id, id)?.arguments) || [];
  }
}

/** The number that a reference names; undefined where it is none. */
export function reference(argument) {
  return argument?.type === 5 ? argument.value : undefined;
}

export function references(argument) {
  return Array.isArray(argument) ? argument.map(reference).filter((id) => id !== undefined) : [];
}

/** The text of a string, number or typed value; empty where there is none. */
export function text(argument) {
  if (argument === null || argument === undefined) return '';
  if (Array.isArray(argument)) return argument.map(text).join(', ');
  return argument.value === null || argument.value === undefined ? '' : String(argument.value);
}
