/** Format measured numbers with their error, rounded to its digits, in a unit of suitable size. */

import { format, localized, pretty } from "./units.js";

/** For each SI unit: the units that are shown, the largest first, with size and symbol. */
const LADDERS = {
  s: [[1, "s"], [1e-3, "ms"], [1e-6, "µs"]],
  m: [[0.1, "m", 1], [1e-3, "mm"], [1e-6, "µm"]],
  kg: [[1, "kg"], [1e-3, "g"]],
  N: [[1e3, "kN"], [1, "N"], [1e-3, "mN"]],
  "N/m": [[1e6, "MN/m"], [1e3, "kN/m"], [1, "N/m"]],
  J: [[1, "J"], [1e-3, "mJ"]],
  V: [[1, "V"], [1e-3, "mV"]],
};

/** Return a value with its error, if it has one, and its unit: "30.00 ± 0.06 ms". */
export function formatMeasured(value, error, unit) {
  if (value === null) return "–";
  if (typeof value !== "number") return String(value);
  const size = Math.abs(value) || Math.abs(error ?? 0);
  const ladder = LADDERS[unit] ?? [];
  const [from, name, own] = ladder.find(([least]) => size >= least) ?? ladder.at(-1) ?? [1, unit];
  const factor = own ?? from;
  const written = name ? ` ${pretty(name).replace("^2", "²")}` : "";
  if (!error || !Number.isFinite(error)) return `${format(value / factor, 4)}${written}`;
  const [number, spread] = rounded(value / factor, error / factor);
  return `${number} ± ${spread}${written}`;
}

/** Return a value with its error without a unit, "6.41 ± 0.05"; null without an error. */
export function withSpread({ value, error } = {}) {
  if (typeof value !== "number" || !(error > 0)) return null;
  return rounded(value, error).join(" ± ");
}

/** Return a value and its error, rounded where the error's second digit is, or its first from 3 on. */
function rounded(value, error) {
  const digit = Math.floor(Math.log10(error));
  const decimals = error / 10 ** digit < 2.95 ? 1 - digit : -digit;
  if (Math.abs(value) >= 1e6 || decimals > 8) return [format(value, 4), format(error, 2)];
  const write = (number) => {
    const step = 10 ** -decimals;
    const text = decimals > 0 ? number.toFixed(decimals) : String(Math.round(number / step) * step);
    return localized(text.replace("-", "−"));
  };
  return [write(value), write(error)];
}
