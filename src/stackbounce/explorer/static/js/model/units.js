/** Units of texts: "58 mm" is 0.058 m. All units that the package reads are in the data that it made. */

import { InvalidType, InvalidValue, SPACES, finite, shownAsGiven, writeFloat } from "./errors.js";
import { known } from "./known.js";

const WRITTEN = /^([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,4})?)[\s\x1c-\x1f\x85]*([^]*)$/;
const LETTERS = "[\\p{L}\\p{Nl}\\p{No}]+"; // raised digits are letters, too
const TERM = `${LETTERS}(?:(?:\\*\\*|\\^)-?[0-9](?:\\.[0-9]{1,3})?)?`;
const UNIT = new RegExp(`^(?:%|${TERM}(?:\\s*[*/·\\s]\\s*${TERM}){0,5})$`, "u");
const POWER = /^(.*?)(?:\^(-?[0-9]+(?:\.[0-9]+)?))?$/;
const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";
const WORDS = [
  [" squared", "$1^2", false],
  [" cubed", "$1^3", false],
  ["cubic ", "$1^3", true],
  ["square ", "$1^2", true],
  ["sq ", "$1^2", true],
].map(([word, made, first]) => [new RegExp(first ? `${word}(${LETTERS})` : `(${LETTERS})${word}`, "gu"), made]);
const SAME = 1e-9; // powers of a dimension that agree so well are the same

/** Return a number of JSON, or a text with a unit, in an SI unit; `name` begins the message of an error. */
export function quantity(value, unit, name) {
  const message = () => messageOf(name, value, unit);
  if (typeof value !== "string") {
    if (typeof value !== "number") throw new InvalidType(message());
    return finite(name, value, unit);
  }
  const found = WRITTEN.exec(stripped(value));
  if (!found) throw new InvalidValue(message());
  const [, number, written] = found;
  if (!written) return finite(name, Number(number), unit);
  const { factor, unknown } = conversion(written, unit);
  if (factor === null) throw new InvalidValue(message() + (unknown ? ", of unknown unit" : ""));
  return finite(name, product(number, writeFloat(factor)), unit);
}

/** Return a text without white space around it, as Python strips it. */
export function stripped(text) {
  let [from, end] = [0, text.length];
  while (from < end && SPACES.test(text[from])) from += 1;
  while (end > from && SPACES.test(text[end - 1])) end -= 1;
  return text.slice(from, end);
}

function messageOf(name, value, unit) {
  const [kind, example] = known.kinds[unit] ?? ["a quantity", `20 ${unit}`];
  const number = unit ? `a number of ${unit}` : "a number";
  return `${name} must be ${kind} (${number} or a string such as "${example}"), got ${shownAsGiven(value)}`;
}

/** Return the factor that makes a unit an SI unit, null if there is none; `unknown` if it has an unknown name. */
function conversion(written, unit) {
  if (!UNIT.test(written)) return { factor: null };
  const [one, other] = [measure(written), measure(unit)];
  if (one.unknown) return { factor: null, unknown: true };
  const names = new Set([...Object.keys(one.dimensions ?? {}), ...Object.keys(other.dimensions)]);
  const power = (of, name) => of.dimensions[name] ?? 0;
  const fits = one.dimensions && [...names].every((name) => Math.abs(power(one, name) - power(other, name)) < SAME);
  const factor = fits ? one.factor / other.factor : null;
  return { factor: factor > 0 && Number.isFinite(factor) ? factor : null };
}

/** Return a unit's factor and dimensions; no dimensions where it is no multiple of an SI unit. */
function measure(written) {
  if (written === "") return { factor: 1, dimensions: {} };
  let plain = written.replaceAll("·", "*").replaceAll("**", "^").replaceAll(" per ", "/").replace(/^%$/, "percent");
  for (const [word, made] of WORDS) plain = plain.replace(word, made);
  plain = plain.replace(new RegExp(`[${RAISED}]+`, "gu"), (digits) => `^${[...digits].map((one) => RAISED.indexOf(one)).join("")}`);
  const parts = plain.replace(/\s*([*/])\s*/g, "$1").replace(/\s+/g, "*").split(/([*/])/);
  const all = { factor: 1, dimensions: {} };
  for (let i = 0; i < parts.length; i += 2) {
    const [, name, raised] = POWER.exec(parts[i]);
    const power = Number(raised ?? 1) * (parts[i - 1] === "/" ? -1 : 1);
    const found = named(name);
    if (!found) return { unknown: true };
    const [factor, dimensions] = found;
    if (factor === null) return { factor: null };
    all.factor *= power === 1 ? factor : factor ** power;
    for (const [one, own] of Object.entries(dimensions)) all.dimensions[one] = (all.dimensions[one] ?? 0) + own * power;
  }
  return all;
}

/** Return the factor and the dimensions of a name such as "mm" or "metres"; undefined where it is none. */
function named(name) {
  const { names, prefixes } = known.units;
  const own = (one) => (Object.hasOwn(names, one) ? names[one] : undefined);
  const found = own(name);
  if (found !== undefined) return dimensioned(found, 1);
  for (const ending of ["", "s"]) {
    if (!name.endsWith(ending)) continue;
    const body = name.slice(0, name.length - ending.length);
    if (ending && own(body) !== undefined && [...body].length > 1) return dimensioned(own(body), 1);
    for (const [prefix, size] of prefixes) {
      const rest = body.slice(prefix.length);
      if (!body.startsWith(prefix) || own(rest) === undefined) continue;
      if (ending && [...rest].length === 1) continue;
      return dimensioned(own(rest), size);
    }
  }
  return undefined;
}

function dimensioned([factor, place], size) {
  return [factor === null ? null : factor * size, known.units.dimensions[place] ?? {}];
}

/** Return the float nearest to the product of two decimal numbers: 24.8 and 0.001 give 0.0248. */
function product(one, other) {
  const [a, b] = [decimal(one), decimal(other)];
  return Number(`${a.digits * b.digits}e${a.power + b.power}`);
}

function decimal(text) {
  const [number, power] = text.toLowerCase().split("e");
  const [whole, part = ""] = number.split(".");
  const sign = whole.startsWith("-") ? -1n : 1n;
  return { digits: sign * BigInt(`${whole.replace(/^[+-]/, "")}${part}` || "0"), power: Number(power ?? 0) - part.length };
}
