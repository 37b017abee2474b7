/** The sides of a line or a map: scales, ticks, titles, first ends; and the numbers of a drop that lie along them. */

import { complete, gapsOf, valueAt, withValue } from "../../set_up/drops.js";
import { clean, format, pretty, shownUnit } from "../../words/words.js";

/** Return `{part(value), value(part)}`: a side's places from 0 to 1. */
export function sideOf({ low, high, log }) {
  if (log) {
    const range = Math.log(high / low);
    return { part: (value) => Math.log(value / low) / range, value: (part) => low * Math.exp(part * range) };
  }
  return { part: (value) => (value - low) / (high - low), value: (part) => low + part * (high - low) };
}

/** Return ticks `{value, named}` between two ends; about `most` of them are named. */
export function ticks(low, high, log, most) {
  const [from, to] = low < high ? [low, high] : [high, low];
  if (log && to / from >= 4) return decades(from, to, most);
  const step = niceStep((to - from) / most);
  const first = Math.ceil(from / step - 1e-9);
  const last = Math.floor(to / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, i) => ({ value: clean((first + i) * step), named: true }));
}

/** Return the nice number (1, 2 or 5 times a power of ten) that is not below another. */
function niceStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * [1, 2, 5, 10].find((nice) => nice * power >= least * (1 - 1e-9));
}

function decades(low, high, most) {
  const span = Math.log10(high / low);
  const named = span < 1.4 ? [1, 2, 3, 5, 7] : span < 3.2 && most >= 5 ? [1, 2, 5] : [1];
  const skip = Math.max(1, Math.ceil(span / most));
  const found = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); power += 1) {
    for (let digit = 1; digit < 10; digit += 1) {
      const value = clean(digit * 10 ** power);
      if (value < low * (1 - 1e-9) || value > high * (1 + 1e-9)) continue;
      found.push({ value, named: named.includes(digit) && (digit > 1 || power % skip === 0) });
    }
  }
  return found;
}

/** Return a side's ticks in the units that people read, and its title. */
export function marks(side, { label, unit }, most) {
  const { unit: name, size } = shownUnit(unit, unit === "m" && Math.max(Math.abs(side.low), Math.abs(side.high)) > 0.2);
  const places = sideOf(side);
  const found = ticks(clean(side.low / size), clean(side.high / size), side.log, most);
  return {
    title: name ? `${label} (${pretty(name)})` : label,
    ticks: found.map(({ value, named }) => ({
      part: places.part(value * size),
      text: named ? format(value, 4) : null,
    })),
  };
}

/** Return a title, shortened where there is no room. */
export function fitting(ctx, title, width) {
  return ctx.measureText(title).width <= width ? title : title.replace(/, .*?(?= \(|$)/, "");
}

/** The first ends of each kind of number, in SI units, even in ratios or not. */
const ENDS = {
  mass_ratio: { low: 0.1, high: 100, log: true },
  stiffness_ratio: { low: 0.1, high: 100, log: true },
  restitution: { low: 0.05, high: 1, log: false },
  exponent: { low: 1, high: 3, log: false },
  gaps: { low: 0, high: 0.01, log: false },
  offset: { low: 0, high: 0.01, log: false },
  impact_speed: { low: 0.5, high: 10, log: false },
  height: { low: 0.1, high: 3, log: false },
  gravity: { low: 0, high: 20, log: false },
  velocities: { low: -5, high: 5, log: false },
};

/** Return the side over a number: `{path, low, high, log}`, with its present value inside. */
export function firstSide({ path, value }) {
  const parts = path.split(".");
  const kind = ENDS[parts[0]] ?? ENDS[parts.at(-1)];
  if (!kind) {
    if (value > 0) return { path, low: nice(value / 10), high: nice(value * 10), log: true };
    return { path, low: 0, high: 1, log: false };
  }
  const air = kind.log ? 2 : 1;
  const low = value < kind.low ? nice(kind.log ? value / air : value) : kind.low;
  const high = value > kind.high ? nice(value * (kind.log ? air : 1.5)) : kind.high;
  return { path, low, high, log: kind.log };
}

function nice(value) {
  return Number(value.toPrecision(2));
}

/** Return whether an axis can be drawn: its ends differ, and are above 0 on a logarithmic scale. */
export function isSide(side) {
  if (!side || typeof side.path !== "string") return false;
  const ends = [side.low, side.high].every((end) => typeof end === "number" && Number.isFinite(end));
  return ends && side.low !== side.high && (!side.log || Math.min(side.low, side.high) > 0);
}

/** Return a number with a convenient unit. */
export function quantity(value, unit) {
  const { unit: name, size } = shownUnit(unit, unit === "m" && Math.abs(value) >= 0.1);
  return `${format(clean(value / size), 3)}${name ? ` ${pretty(name)}` : ""}`;
}

/** Return a label without the explanation after its comma. */
export function brief(label) {
  return label.replace(/, .*$/, "");
}

/** For each ratio: the number that it sets, and the number that it refers to. */
const RATIOS = {
  mass_ratio: ["balls.0.mass", "balls.1.mass"],
  stiffness_ratio: ["contacts.0.stiffness", "contacts.1.stiffness"],
};

/** Return a drop with numbers changed, by path; ratios last, as they refer to others. */
export function withNumbers(drop, numbers) {
  const own = Object.entries(numbers).sort(([a], [b]) => Number(a in RATIOS) - Number(b in RATIOS));
  let next = { ...drop, gaps: gapsOf(drop) };
  for (const [path, value] of own) {
    const [set, other] = RATIOS[path] ?? [path];
    const reference = other ? other.split(".").reduce((part, key) => part[key], next) : 1;
    next = withValue(next, set, clean(Number((value * reference).toPrecision(4))));
  }
  return next;
}

/** Return a number of a drop, or a ratio of two; undefined where the drop does not say it. */
export function numberIn(drop, path) {
  const [set, other] = RATIOS[path] ?? [path];
  const whole = complete(drop);
  const value = valueAt(whole, set);
  return other ? value / valueAt(whole, other) : value;
}

/** Return whether two drops have the same drawing over some numbers: they differ in these alone. */
export function haveSameDrawing(drop, other, paths) {
  const rest = (whole) => paths.reduce((left, path) => withValue(left, RATIOS[path]?.[0] ?? path, 0), complete(whole));
  return JSON.stringify(rest(drop)) === JSON.stringify(rest(other));
}

/** Return whether two numbers are the same, or one is set by the other. */
export function depends(path, other) {
  if (other === undefined) return false;
  return path === other || RATIOS[path]?.[0] === other || RATIOS[other]?.[0] === path;
}

/** Return the places of the smallest and the largest value, null where there is none; of counts the endless ones, -1, are the most. */
export function extremes(values, areCounts) {
  const order = (value) => (areCounts && value < 0 ? Infinity : value);
  let [low, high] = [null, null];
  values.forEach((value, i) => {
    if (value === null) return;
    if (low === null || order(value) < order(values[low])) low = i;
    if (high === null || order(value) > order(values[high])) high = i;
  });
  return [low, high];
}
