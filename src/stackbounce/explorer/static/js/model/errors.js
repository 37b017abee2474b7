/** Errors in the user's numbers, the checks that raise them, and numbers as Python writes them. */

/** Something is wrong with what somebody gave: the message is for them, in one line. */
export class InvalidValue extends Error {}

/** Return a float as Python writes it. */
export function writeFloat(value) {
  if (Number.isNaN(value)) return "nan";
  if (!Number.isFinite(value)) return value > 0 ? "inf" : "-inf";
  if (Object.is(value, -0)) return "-0.0";
  const [mantissa, power] = value.toExponential().split("e");
  const exponent = Number(power);
  if (exponent < -4 || exponent >= 16) return `${mantissa}e${exponent < 0 ? "-" : "+"}${padded(exponent)}`;
  const text = exponent < 0 ? value.toFixed(mantissa.replace(/[-.]/g, "").length - 1 - exponent) : String(value);
  return text.includes(".") ? text : `${text}.0`;
}

function padded(exponent) {
  return String(Math.abs(exponent)).padStart(2, "0");
}

/** Return a number as Python's format g writes it. */
export function general(value, digits = 6) {
  if (value === 0) return "0";
  if (!Number.isFinite(value)) return writeFloat(value);
  const [mantissa, power] = value.toExponential(digits - 1).split("e");
  const exponent = Number(power);
  if (exponent >= -4 && exponent < digits) return String(Number(value.toPrecision(digits)));
  return `${String(Number(mantissa))}e${exponent < 0 ? "-" : "+"}${padded(exponent)}`;
}

/** Return a number, a text, a list or nothing as Python writes it in code. */
export function repr(value) {
  if (Array.isArray(value)) return `[${value.map(repr).join(", ")}]`;
  if (typeof value === "number") return writeFloat(value);
  return typeof value === "string" ? JSON.stringify(value) : "None";
}

function checked(name, value, right, holds) {
  if (typeof value === "number" && Number.isFinite(value) && holds(value)) return value;
  throw new InvalidValue(`${name} must be ${right}, got ${typeof value === "number" ? writeFloat(value) : JSON.stringify(value)}`);
}

const of = (unit) => (unit ? ` of ${unit}` : "");

export function finite(name, value, unit = "") {
  return checked(name, value, `a finite number${of(unit)}`, () => true);
}

export function positive(name, value, unit = "") {
  return checked(name, value, `a positive number${of(unit)}`, (number) => number > 0);
}

export function nonNegative(name, value, unit = "") {
  return checked(name, value, `a number${of(unit)}, 0 or above`, (number) => number >= 0);
}

export function fraction(name, value, { zero = true } = {}) {
  if (zero) return between(name, value, 0, 1);
  return checked(name, value, "a number above 0 and at most 1", (number) => number > 0 && number <= 1);
}

export function between(name, value, low, high) {
  return checked(name, value, `a number from ${general(low)} to ${general(high)}`, (number) => number >= low && number <= high);
}

/** Check a number by the limits that the catalogue has of it: `{words, least, most}`. */
export function within(name, value, { right, least, most }) {
  return checked(name, value, right, (number) => number >= least && number <= most);
}
