/** Colours for numbers: viridis, which is perceptually uniform and safe for colour-blind readers. */

import { extentOf } from "../extent.js";

/** Seventeen of its colours, evenly spread (S. van der Walt and N. Smith, matplotlib, CC0). */
const VIRIDIS =
  "440154 48186a 472d7b 424086 3b528b 33638d 2c728e 26828e 21918c 1fa088 28ae80 3fbc73 5ec962 84d44b addc30 d8e219 fde725"
    .split(" ")
    .map((hex) => [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16)));

/** Return the colour [r, g, b] of a part of the range, from 0 to 1. */
export function colorAt(part) {
  const place = Math.min(Math.max(part, 0), 1) * (VIRIDIS.length - 1);
  const low = Math.min(Math.floor(place), VIRIDIS.length - 2);
  return VIRIDIS[low].map((level, i) => Math.round(level + (place - low) * (VIRIDIS[low + 1][i] - level)));
}

/** Return a colour as CSS writes it. */
export function css([red, green, blue]) {
  return `rgb(${red} ${green} ${blue})`;
}

/** Return whether black is read better than white on a colour. */
export function isLight([red, green, blue]) {
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue > 125;
}

/** From here on counts share a colour. */
export const MANY = 10;

/**
 * Return how values become colours: `{kind, low, high, color(value)}` of a range, or of whole counts
 * `{kind, counts, color(value)}`; `MANY` stands for all above it, -1 is a count without end and comes last.
 */
export function scaleOfColors(values, whole) {
  if (whole) {
    const known = values.flat().filter((value) => value !== null);
    const kind = (count) => Math.min(count, MANY);
    const order = (count) => (count < 0 ? Infinity : count);
    const counts = [...new Set(known.map(kind))].sort((a, b) => order(a) - order(b));
    const part = (count) => (counts.length > 1 ? counts.indexOf(count) / (counts.length - 1) : 0.5);
    return { kind: "counts", counts, color: (count) => colorAt(part(kind(count))) };
  }
  let [low, high] = extentOf(values.flat());
  if (low > high) [low, high] = [0, 1];
  const least = 1e-6 * Math.max(Math.abs(low), Math.abs(high), 1e-9); // what is the same but for rounding
  if (high - low < least) {
    const air = 0.5 * Math.abs(high) || 1;
    [low, high] = [low - air, high + air];
  }
  return { kind: "range", low, high, color: (value) => colorAt((value - low) / (high - low)) };
}
