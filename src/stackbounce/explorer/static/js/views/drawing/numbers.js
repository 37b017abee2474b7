/** The numbers of a drop that lie along the sides of a drawing: in words, and put into the drop. */

import { complete, gapsOf, valueAt, withValue } from "../../set_up/drops.js";
import { clean, format, pretty, shownUnit } from "../../words/words.js";

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
