// Where on Earth the file's site lies, and where its true north is.
import { reference, references, text } from './model.mjs';

/** Degrees of an IfcCompoundPlaneAngleMeasure: degrees, minutes, seconds and millionths of them, all of one sign. */
function degrees(argument) {
  if (!Array.isArray(argument) || argument.length < 3) return undefined;
  const [whole, minutes, seconds, millionths = 0] = argument.map((part) => Number(text(part)));
  const angle = whole + minutes / 60 + (seconds + millionths / 1e6) / 3600;
  return Number.isFinite(angle) ? angle : undefined;
}

const prefixes = { MILLI: 1e-3, CENTI: 1e-2, DECI: 1e-1, DECA: 10, HECTO: 100, KILO: 1000 };

/** Metres of the file's unit of length; undefined where it is none that is known here. */
function metresOfUnit(model) {
  for (const assignment of model.ofType('IFCUNITASSIGNMENT')) {
    for (const unit of references(model.arguments(assignment)[0])) {
      const arguments_ = model.arguments(unit);
      if (!arguments_.some((argument) => text(argument) === 'LENGTHUNIT')) continue;
      const words = arguments_.map(text);
      if (words.includes('METRE')) return prefixes[words.find((word) => word in prefixes)] ?? 1;
      const measure = arguments_.map(reference).filter((id) => id !== undefined).at(-1); // behind its dimensions
      const factor = measure === undefined ? NaN : Number(text(model.arguments(measure)[0]));
      return Number.isFinite(factor) ? factor : undefined;
    }
  }
  return undefined;
}

/** The direction to true north in plan, x and y of the file's axes, of length 1. */
function trueNorth(model) {
  for (const context of model.ofType('IFCGEOMETRICREPRESENTATIONCONTEXT')) {
    const direction = reference(model.arguments(context)[5]);
    if (direction === undefined) continue;
    const [x, y] = (model.arguments(direction)[0] ?? []).map((ratio) => Number(text(ratio)));
    const length = Math.hypot(x, y);
    if (length > 0 && Number.isFinite(length)) return [x / length, y / length];
  }
  return [0, 1];
}

/** { latitude, longitude, elevation, north }: degrees, metres, as trueNorth(); undefined where no site says a place. */
export function geoPlace(model) {
  for (const site of model.ofType('IFCSITE')) {
    const arguments_ = model.arguments(site);
    const latitude = degrees(arguments_[9]), longitude = degrees(arguments_[10]);
    if (latitude === undefined || longitude === undefined) continue;
    if (Math.abs(latitude) > 90 || Math.abs(longitude) > 180) return { wrong: `#${site}` };
    const elevation = Number(text(arguments_[11])) * (metresOfUnit(model) ?? 0);
    return { latitude, longitude, elevation: Number.isFinite(elevation) ? elevation : 0, north: trueNorth(model) };
  }
  return undefined;
}
