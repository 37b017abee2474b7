/** Errors in the user's numbers, and the checks that raise them: the same words as stackbounce/errors.py. */

/** Something is wrong with what somebody gave: the message is for them, in one line. */
export class Wrong extends Error {}

export class InvalidValue extends Wrong {}

export class InvalidType extends Wrong {}

const SHOWN = 60; // characters of a value in a message
const CLOSE = 0.6; // ratio of two names from which one is suggested for the other

/** Return a value of a drop as a short text for a message; numbers are floats, as Python's. */
export function shown(value) {
  return shortened(typeof value === "number" ? writeFloat(value) : repr(value, writeFloat));
}

/** Return a value as it came in JSON, where 1 is a whole number, as a short text for a message. */
export function shownAsGiven(value) {
  return shortened(typeof value === "number" ? writeNumber(value) : repr(value, writeNumber));
}

function shortened(text) {
  const line = [...text.split(SPACES).filter(Boolean).join(" ")];
  return line.length <= SHOWN ? line.join("") : `${line.slice(0, SHOWN - 3).join("")}...`;
}

/** What Python counts as white space. */
export const SPACES = /[\t-\r\x1c-\x20\x85\xa0\u1680\u2000-\u200a\u2028\u2029\u202f\u205f\u3000]+/u;

/** Return a number of JSON as Python reads and writes it: whole ones have no point. */
function writeNumber(value) {
  return Number.isInteger(value) && Math.abs(value) < 1e21 ? String(value) : writeFloat(value);
}

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
  if (value === 0) return Object.is(value, -0) ? "-0" : "0";
  if (!Number.isFinite(value)) return writeFloat(value);
  const [mantissa, power] = value.toExponential(digits - 1).split("e");
  const exponent = Number(power);
  if (exponent >= -4 && exponent < digits) return String(Number(value.toPrecision(digits)));
  return `${String(Number(mantissa))}e${exponent < 0 ? "-" : "+"}${padded(exponent)}`;
}

/** Return a value as Python writes it in code. */
export function repr(value, number = writeFloat) {
  if (value === null || value === undefined) return "None";
  if (typeof value === "number") return number(value);
  if (typeof value === "bigint") return String(value);
  if (typeof value === "boolean") return value ? "True" : "False";
  if (typeof value === "string") return quoted(value);
  if (Array.isArray(value)) return `[${value.map((one) => repr(one, number)).join(", ")}]`;
  return `{${Object.entries(value).map(([key, one]) => `${quoted(key)}: ${repr(one, number)}`).join(", ")}}`;
}

function quoted(text) {
  const mark = text.includes("'") && !text.includes('"') ? '"' : "'";
  const inside = [...text].map((one) => {
    if (one === "\\" || one === mark) return `\\${one}`;
    const named = { "\n": "\\n", "\r": "\\r", "\t": "\\t" }[one];
    return named ?? (isPrintable(one) ? one : escaped(one.codePointAt(0)));
  });
  return mark + inside.join("") + mark;
}

function isPrintable(one) {
  return one === " " || !/[\p{C}\p{Z}]/u.test(one);
}

function escaped(code) {
  if (code < 0x100) return `\\x${code.toString(16).padStart(2, "0")}`;
  return code < 0x10000 ? `\\u${code.toString(16).padStart(4, "0")}` : `\\U${code.toString(16).padStart(8, "0")}`;
}

// checks of numbers

function checked(name, value, right, holds) {
  const message = `${name} must be ${right}, got ${shown(value)}`;
  if (typeof value !== "number") throw new InvalidType(message);
  if (!Number.isFinite(value) || !holds(value)) throw new InvalidValue(message);
  return value;
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
  if (zero) return checked(name, value, "a number from 0 to 1", (number) => number >= 0 && number <= 1);
  return checked(name, value, "a number above 0 and at most 1", (number) => number > 0 && number <= 1);
}

export function between(name, value, low, high = Infinity, unit = "") {
  const range = Number.isFinite(high) ? ` from ${general(low)} to ${general(high)}` : `, ${general(low)} or above`;
  return checked(name, value, `a number${of(unit)}${range}`, (number) => number >= low && number <= high);
}

/** Check a number by the limits that the catalogue has of it: `{words, least, most}`. */
export function within(name, value, { right, least, most }) {
  return checked(name, value, right, (number) => number >= least && number <= most);
}

// unknown names

/** Return the end of a message about an unknown name: the closest one, and all that are known. */
export function nearest(name, known) {
  const word = (typeof name === "string" ? [...name].slice(0, 60).join("") : shownAsGiven(name)).toLowerCase();
  let best = null;
  for (const one of known) {
    const close = similarity(one.toLowerCase(), word);
    if (close < CLOSE) continue;
    if (!best || close > best.close || (close === best.close && one.toLowerCase() > best.one.toLowerCase())) best = { close, one };
  }
  return best ? `did you mean ${best.one}? Known: ${known.join(", ")}` : `known: ${known.join(", ")}`;
}

/** Return how alike two texts are, from 0 to 1: Ratcliff and Obershelp's measure, as Python's difflib has it. */
function similarity(a, b) {
  const [left, right] = [[...a], [...b]];
  const total = left.length + right.length;
  return total ? (2 * matching(left, right)) / total : 1;
}

/** Return how many letters are in common blocks: the longest one, and those before and after it. */
function matching(a, b) {
  let [size, atA, atB] = [0, 0, 0];
  let before = [];
  a.forEach((letter, i) => {
    const now = [];
    b.forEach((other, j) => {
      if (letter !== other) return;
      now[j] = (before[j - 1] ?? 0) + 1;
      if (now[j] > size) [size, atA, atB] = [now[j], i - now[j] + 1, j - now[j] + 1];
    });
    before = now;
  });
  if (!size) return 0;
  return size + matching(a.slice(0, atA), b.slice(0, atB)) + matching(a.slice(atA + size), b.slice(atB + size));
}
