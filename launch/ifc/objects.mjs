// What a product is: number, name, GUID, kind, storey, layer, property sets.
import { reference, references, text } from './model.mjs';

/** The arguments of relations: which are related, and to what. */
const relations = {
  IFCRELCONTAINEDINSPATIALSTRUCTURE: { children: 4, parent: 5 },
  IFCRELAGGREGATES: { children: 5, parent: 4 },
  IFCRELNESTS: { children: 5, parent: 4 },
};

export class Objects {
  #model;
  #writer;
  #parents = new Map();
  #definitions = new Map(); // product to its property sets
  #layers = new Map(); // representation or item to its layer
  #written = new Map(); // property set to its number in the stream
  #storeys = new Map();
  #storeyCode;

  constructor(model, writer) {
    this.#model = model;
    this.#writer = writer;
    this.#storeyCode = model.code('IFCBUILDINGSTOREY');
    for (const [type, { children, parent }] of Object.entries(relations)) {
      this.#each(type, (values) => {
        const above = reference(values[parent]);
        for (const child of references(values[children])) if (above !== undefined) this.#parents.set(child, above);
      });
    }
    this.#each('IFCRELDEFINESBYPROPERTIES', (values) => {
      const sets = reference(values[5]) !== undefined ? [reference(values[5])] : references(values[5]);
      for (const product of references(values[4])) {
        if (!this.#definitions.has(product)) this.#definitions.set(product, []);
        this.#definitions.get(product).push(...sets);
      }
    });
    this.#each('IFCPRESENTATIONLAYERASSIGNMENT', (values) => {
      for (const item of references(values[2])) this.#layers.set(item, text(values[0]));
    });
  }

  /** Writes the product; gives its number in the stream, and its name. */
  write(id, product) {
    const values = product.values;
    const sets = (this.#definitions.get(id) ?? []).map((set) => this.#propertySet(set)).filter((set) => set !== undefined);
    const name = text(values[2]);
    const described = {
      id: `#${id}`, name, guid: text(values[0]), type: product.type,
      storey: this.#storeyOf(id), layer: this.#layerOf(product),
    };
    return { number: this.#writer.object(described, sets), name };
  }

  #each(type, take) {
    for (const id of this.#model.ofType(type)) {
      try {
        take(this.#model.arguments(id));
      } catch {
        // A relation that cannot be read says nothing about geometry.
      }
    }
  }

  #storeyOf(id) {
    const above = this.#parents.get(id);
    if (above === undefined) return '';
    if (this.#storeys.has(above)) return this.#storeys.get(above);
    let name = '';
    const seen = new Set();
    for (let at = above; at !== undefined && !seen.has(at); at = this.#parents.get(at)) {
      seen.add(at);
      if (this.#model.api.GetLineType(this.#model.id, at) !== this.#storeyCode) continue;
      name = text(this.#model.arguments(at)[2]);
      break;
    }
    this.#storeys.set(above, name);
    return name;
  }

  #layerOf(product) {
    if (this.#layers.size === 0) return '';
    for (const { id, items } of product.representations) {
      const named = [id, ...items].find((part) => this.#layers.has(part));
      if (named !== undefined) return this.#layers.get(named);
    }
    return '';
  }

  #propertySet(id) {
    if (this.#written.has(id)) return this.#written.get(id);
    let number;
    try {
      const values = this.#model.arguments(id);
      const members = references(values[4]).length > 0 ? values[4] : values[5]; // of quantities
      const pairs = references(members).map((member) => this.#pair(member)).filter((pair) => pair !== undefined);
      if (pairs.length > 0) number = this.#writer.propertySet(text(values[2]), pairs);
    } catch {
      // Not a set that can be read: the product is drawn all the same.
    }
    this.#written.set(id, number);
    return number;
  }

  /** Name and value of a property with one value, or of a quantity. */
  #pair(id) {
    const type = this.#model.typeName(this.#model.api.GetLineType(this.#model.id, id));
    const values = this.#model.arguments(id);
    if (type === 'IfcPropertySingleValue' || type === 'IfcPropertyEnumeratedValue' || type === 'IfcPropertyListValue')
      return [text(values[0]), text(values[2])];
    return type.startsWith('IfcQuantity') ? [text(values[0]), text(values[3])] : undefined;
  }
}
