// Writes prisms as a building of IFC4 with web-ifc: node write_ifc.mjs PLAN.json FILE.ifc. The plan is that of
// the sample `kit`: storeys with a name and an elevation, solids with an outline and how far it reaches across it,
// metres, z up.
import { createHash } from 'node:crypto';
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';

const { IfcAPI, IFC4 } = createRequire(import.meta.url)('web-ifc');

/** The kind of product by the first word of its name. */
const kinds = { Slab: 'IfcSlab', Wall: 'IfcWall', Door: 'IfcDoor', Column: 'IfcColumn', Roof: 'IfcRoof', Table: 'IfcFurniture', Bench: 'IfcFurniture' };

/** 22 digits of IFC's base 64 that depend on the name alone. */
function guid(name) {
  const digits = '0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$';
  let number = BigInt(`0x${createHash('sha1').update(name).digest('hex').slice(0, 32)}`);
  let text = '';
  for (let i = 0; i < 22; ++i, number >>= 6n) text = digits[Number(number & 63n)] + text;
  return new IFC4.IfcGloballyUniqueId(text);
}

const label = (text) => new IFC4.IfcLabel(text);
const length = (metres) => new IFC4.IfcLengthMeasure(metres);
const point = (...coordinates) => new IFC4.IfcCartesianPoint(coordinates.map(length));
const direction = (...ratios) => new IFC4.IfcDirection(ratios.map((ratio) => new IFC4.IfcReal(ratio)));
const axes = (origin, z = null, x = null) => new IFC4.IfcAxis2Placement3D(point(...origin), z && direction(...z), x && direction(...x));

/** elevation: of the storey that the solid is placed in. */
function prism(solid, elevation) {
  const outline = new IFC4.IfcPolyline([...solid.outline, solid.outline[0]].map(([x, y]) => point(x, y)));
  const profile = new IFC4.IfcArbitraryClosedProfileDef(IFC4.IfcProfileTypeEnum.AREA, null, outline);
  // Across x and z, the third axis of right-handed ones points along −y.
  const position = solid.upright ? axes([0, 0, solid.from - elevation]) : axes([0, solid.to, -elevation], [0, -1, 0], [1, 0, 0]);
  return new IFC4.IfcExtrudedAreaSolid(profile, position, direction(0, 0, 1), new IFC4.IfcPositiveLengthMeasure(solid.to - solid.from));
}

function style(colour) {
  const [red, green, blue] = colour.map((channel) => new IFC4.IfcNormalisedRatioMeasure(channel));
  const shading = new IFC4.IfcSurfaceStyleShading(new IFC4.IfcColourRgb(null, red, green, blue), null);
  return new IFC4.IfcSurfaceStyle(label(colour.map((channel) => Math.round(255 * channel)).join(' ')), IFC4.IfcSurfaceSide.BOTH, [shading]);
}

/** Of a class with this many attributes, by their numbers; all others are null. */
function entity(kind, count, attributes) {
  const values = new Array(count).fill(null);
  for (const [index, value] of Object.entries(attributes)) values[index] = value;
  return new IFC4[kind](...values);
}

function write(plan) {
  const api = new IfcAPI();
  return api.Init().then(() => {
    const model = api.CreateModel({ schema: 'IFC4', name: 'kit.ifc', description: ['ViewDefinition [ReferenceView_V1.2]'],
      authors: [''], organizations: [''], authorization: '' });
    const add = (line) => {
      api.WriteLine(model, line);
      return line;
    };
    const context = add(new IFC4.IfcGeometricRepresentationContext(null, label('Model'), new IFC4.IfcDimensionCount(3),
      new IFC4.IfcReal(1e-5), axes([0, 0, 0]), null));
    const metre = new IFC4.IfcSIUnit(IFC4.IfcUnitEnum.LENGTHUNIT, null, IFC4.IfcSIUnitName.METRE);
    const project = add(new IFC4.IfcProject(guid('project'), null, label('kit'), null, null, null, null, [context], new IFC4.IfcUnitAssignment([metre])));
    const ground = add(new IFC4.IfcLocalPlacement(null, axes([0, 0, 0])));
    const building = add(entity('IfcBuilding', 12, { 0: guid('building'), 2: label('Kit'), 5: ground, 8: IFC4.IfcElementCompositionEnum.ELEMENT }));
    const floors = plan.storeys.map(({ elevation }) => add(new IFC4.IfcLocalPlacement(ground, axes([0, 0, elevation]))));
    const storeys = plan.storeys.map(({ name, elevation }, index) => add(entity('IfcBuildingStorey', 10, { 0: guid(name), 2: label(name),
      5: floors[index], 8: IFC4.IfcElementCompositionEnum.ELEMENT, 9: length(elevation) })));
    add(new IFC4.IfcRelAggregates(guid('buildings'), null, null, null, project, [building]));
    add(new IFC4.IfcRelAggregates(guid('storeys'), null, null, null, building, storeys));
    const styles = new Map();
    const products = plan.solids.map((solid) => {
      const body = add(prism(solid, plan.storeys[solid.storey].elevation));
      const key = solid.colour.join(' ');
      if (!styles.has(key)) styles.set(key, add(style(solid.colour)));
      add(new IFC4.IfcStyledItem(body, [styles.get(key)], null));
      const shape = new IFC4.IfcShapeRepresentation(context, label('Body'), label('SweptSolid'), [body]);
      const kind = kinds[solid.name.split(' ')[0]] ?? 'IfcBuildingElementProxy';
      return add(entity(kind, IFC4[kind].length, { 0: guid(solid.name), 2: label(solid.name),
        5: new IFC4.IfcLocalPlacement(floors[solid.storey], axes([0, 0, 0])), 6: new IFC4.IfcProductDefinitionShape(null, null, [shape]) }));
    });
    storeys.forEach((storey, index) => add(new IFC4.IfcRelContainedInSpatialStructure(guid(`in ${plan.storeys[index].name}`), null, null, null,
      products.filter((_, i) => plan.solids[i].storey === index), storey)));
    return api.SaveModel(model);
  });
}

try {
  const [plan, file] = process.argv.slice(2);
  writeFileSync(file, await write(JSON.parse(readFileSync(plan, 'utf8'))));
  process.exit(0);
} catch (error) {
  console.error(`triptych: web-ifc: ${String(error?.message ?? error).replace(/\s+/g, ' ').slice(0, 160)}`);
  process.exit(1);
}
