/** What Python has and JavaScript lacks, for formulas that are translated from Python. */

import { general, isNumber, writeFloat } from "./errors.js";

export { repr } from "./errors.js";

/** A number out of range: a division by zero, an overflow, no root. */
export class ArithmeticError extends Error {}

export class OverflowError extends ArithmeticError {}

export class ZeroDivisionError extends ArithmeticError {}

export const NOTHING = {};
export const { abs, max, min } = Math;
export const float = Number;
export const tuple = (values) => [...values];
export const dict = Object.fromEntries;
export const reversed = (values) => [...values].reverse();
export const len = (values) => values.length;
export const is_str = (value) => typeof value === "string";
export const partial = (call, ...first) => (...rest) => call(...first, ...rest);

export function div(above, below) {
  if (below === 0) throw new ZeroDivisionError();
  return above / below;
}

export function pow(base, exponent) {
  if (base === 0 && exponent < 0) throw new ZeroDivisionError();
  return real(base ** exponent, base, exponent);
}

/** Return a result, unless finite numbers gave one that is not. */
function real(result, ...given) {
  if (Number.isFinite(result) || !given.every(Number.isFinite)) return result;
  throw new OverflowError();
}

export function truth(value) {
  if (value === null || typeof value !== "object") return Boolean(value);
  return Array.isArray(value) ? value.length > 0 : Object.keys(value).length > 0;
}

export function either(...choices) {
  for (const choice of choices.slice(0, -1)) {
    const value = choice();
    if (truth(value)) return value;
  }
  return choices.at(-1)();
}

export function both(...choices) {
  for (const choice of choices.slice(0, -1)) {
    const value = choice();
    if (!truth(value)) return value;
  }
  return choices.at(-1)();
}

export const united = (one, other) => ({ ...one, ...other });
export const items = (mapping) => Object.entries(mapping);
export const get = (mapping, key, other = null) => (Object.hasOwn(mapping, key) ? mapping[key] : other);
export const append = (list, value) => list.push(value);
export const join = (text, parts) => parts.join(text);
export const zip = (one, other) => one.map((value, i) => [value, other[i]]);
export const enumerate = (values) => values.map((value, i) => [i, value]);
export const sum = (values) => values.reduce((total, value) => total + value, 0);

export function contains(within, value) {
  return Array.isArray(within) ? within.includes(value) : Object.hasOwn(within, value);
}

export function* range(...ends) {
  const [from, to] = ends.length > 1 ? ends : [0, ends[0]];
  for (let i = from; i < to; i += 1) yield i;
}

const KEPT = 256; // results of a function

/** Return a function that keeps its results. */
export function cached(call) {
  const known = new Map();
  return (...given) => {
    const key = given.join();
    if (!known.has(key)) {
      if (known.size >= KEPT) known.clear();
      known.set(key, call(...given));
    }
    return known.get(key);
  };
}

/** Return a value as an f-string writes it: with the format "g", ".3g" or none. */
export function formatted(value, form) {
  if (!isNumber(value)) return String(value);
  return form ? general(value, Number(form.slice(1, -1)) || 6) : writeFloat(value);
}

// Python's module math

const checkedOne = (call) => (x) => real(call(x), x);

export const math = {
  pi: Math.PI,
  inf: Infinity,
  nan: NaN,
  sqrt: checkedOne(Math.sqrt),
  log(x) {
    if (x <= 0) throw new ArithmeticError();
    return Math.log(x);
  },
  isfinite: Number.isFinite,
  atan: Math.atan,
  atan2: Math.atan2,
  copysign: (size, sign) => (sign < 0 || Object.is(sign, -0) ? -Math.abs(size) : Math.abs(size)),
  factorial: (n) => [...range(2, n + 1)].reduce((product, factor) => product * factor, 1),
  gamma,
  fsum,
};
for (const name of ["acos", "acosh", "asin", "asinh", "atanh", "cos", "cosh", "exp", "expm1", "log1p", "log2", "sin", "sinh", "tan", "tanh"]) {
  math[name] = checkedOne(Math[name]);
}

const LANCZOS = 6.024680040776729583740234375;
const ABOVE = [
  23531376880.41075968857200767445163675473, 42919803642.64909876895789904700198885093, 35711959237.35566804944018545154716670596,
  17921034426.03720969991975575445893111267, 6039542586.352028005064291644307297921070, 1439720407.311721673663223072794912393972,
  248874557.8620541565114603864132294232163, 31426415.58540019438061423162831820536287, 2876370.628935372441225409051620849613599,
  186056.2653952234950402949897160456992822, 8071.672002365816210638002902272250613822, 210.8242777515793458725097339207133627117,
  2.506628274631000270164908177133837338626,
];
const BELOW = [0, 39916800, 120543840, 150917976, 105258076, 45995730, 13339535, 2637558, 357423, 32670, 1925, 66, 1];

/** Return the gamma function of a number above 0, by Lanczos's approximation, as Python does. */
function gamma(x) {
  const polynomial = (factors) => factors.reduceRight((value, factor) => value * x + factor, 0);
  const y = x + (LANCZOS - 0.5);
  const short = y - (LANCZOS - 0.5) - x; // what is lost in y
  const rest = polynomial(ABOVE) / polynomial(BELOW) / Math.exp(y);
  const corrected = rest - (short * LANCZOS * rest) / y;
  return real(corrected * y ** (x - 0.5), x);
}

/** Return a sum without round-off: partial sums that do not overlap (J. R. Shewchuk, 1997). */
function fsum(values) {
  const parts = [];
  for (let x of values) {
    let kept = 0;
    for (let y of parts) {
      if (Math.abs(x) < Math.abs(y)) [x, y] = [y, x];
      const high = x + y;
      const low = y - (high - x);
      if (low !== 0) parts[kept++] = low;
      x = high;
    }
    parts.length = kept;
    parts.push(x);
  }
  return parts.reduceRight((total, part) => total + part, 0);
}
