/** A map in words, and the drop that a point of it stands for. */

import { complete, gapsOf, valueAt, withValue } from "../../set_up/drops.js";
import { t } from "../../words/language.js";
import { clean, format, pretty, shownUnit } from "../../words/units.js";
import { count } from "../../words/words.js";

/** Return a number with a convenient unit. */
export function quantity(value, unit) {
  const { unit: name, size } = shownUnit(unit, unit === "m" && Math.abs(value) >= 0.1);
  return `${format(clean(value / size), 3)}${name ? ` ${pretty(name)}` : ""}`;
}

/** Return a label without the explanation after its comma. */
export function brief(label) {
  return label.replace(/, .*$/, "");
}

/** Return what an outcome is at a point, in words. */
export function outcome({ show, unit }, value) {
  if (value === null) return t("not finished");
  return show.startsWith("collisions") ? count(value) : quantity(value, unit);
}

/** Return a point `[x, y]` of two values in words. */
export function place({ x, y }, point) {
  return `${brief(x.label)} ${quantity(point[0], x.unit)}, ${brief(y.label)} ${quantity(point[1], y.unit)}`;
}

/** Return what a map shows as a whole: its ends and where they are. */
export function summary(answer) {
  const { values, x, y, label } = answer;
  let [low, high] = [null, null];
  const order = (value) => (answer.show.startsWith("collisions") && value < 0 ? Infinity : value);
  values.forEach((line, row) =>
    line.forEach((value, column) => {
      if (value === null) return;
      const one = { value, at: [x.values[column], y.values[row]] };
      if (!low || order(value) < order(low.value)) low = one;
      if (!high || order(value) > order(high.value)) high = one;
    }),
  );
  const total = values.length * values[0].length;
  const open = answer.unfinished ? ` ${t("{some} of {all} points, hatched, could not be finished.", { some: answer.unfinished, all: total })}` : "";
  if (!low) return t("No point of this map could be finished.");
  const [least, most] = [outcome(answer, low.value), outcome(answer, high.value)];
  const name = label[0].toUpperCase() + label.slice(1);
  if (least === most) return `${t("{name}: {value} everywhere.", { name, value: least })}${open}`;
  const ends = { name, low: least, where: place(answer, low.at), high: most, there: place(answer, high.at) };
  return `${t("{name}: smallest {low} at {where}; largest {high} at {there}.", ends)}${open}`;
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

/** Return whether two drops have the same map over two numbers: they differ in these alone. */
export function haveSameMap(one, other, paths) {
  const rest = (drop) => paths.reduce((left, path) => withValue(left, RATIOS[path]?.[0] ?? path, 0), complete(drop));
  return JSON.stringify(rest(one)) === JSON.stringify(rest(other));
}

/** Return whether two numbers are the same, or one is set by the other. */
export function depends(path, other) {
  if (other === undefined) return false;
  return path === other || RATIOS[path]?.[0] === other || RATIOS[other]?.[0] === path;
}
