/** A map in words. */

import { brief, extremes, quantity } from "../drawing/numbers.js";
import { t } from "../../words/language.js";
import { capital, count } from "../../words/words.js";

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
  const { x, y, label, unfinished } = answer;
  const values = answer.values.flat();
  const [low, high] = extremes(values, answer.show.startsWith("collisions"));
  if (low === null) return t("No point of this map could be finished.");
  const open = unfinished ? ` ${t("{some} of {all} points, hatched, could not be finished.", { some: unfinished, all: values.length })}` : "";
  const [least, most] = [low, high].map((i) => outcome(answer, values[i]));
  const name = capital(label);
  if (least === most) return `${t("{name}: {value} everywhere.", { name, value: least })}${open}`;
  const at = (i) => place(answer, [x.values[i % x.values.length], y.values[Math.floor(i / x.values.length)]]);
  return `${t("{name}: smallest {low} at {where}; largest {high} at {there}.", { name, low: least, where: at(low), high: most, there: at(high) })}${open}`;
}
