/** A map in words. */

import { brief, quantity } from "../drawing/numbers.js";
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
  const { values, x, y, label } = answer;
  let [low, high] = [null, null];
  const order = (value) => (answer.show.startsWith("collisions") && value < 0 ? Infinity : value);
  values.forEach((line, row) =>
    line.forEach((value, column) => {
      if (value === null) return;
      const point = { value, at: [x.values[column], y.values[row]] };
      if (!low || order(value) < order(low.value)) low = point;
      if (!high || order(value) > order(high.value)) high = point;
    }),
  );
  const total = values.length * values[0].length;
  const open = answer.unfinished ? ` ${t("{some} of {all} points, hatched, could not be finished.", { some: answer.unfinished, all: total })}` : "";
  if (!low) return t("No point of this map could be finished.");
  const [least, most] = [outcome(answer, low.value), outcome(answer, high.value)];
  const name = capital(label);
  if (least === most) return `${t("{name}: {value} everywhere.", { name, value: least })}${open}`;
  const ends = { name, low: least, where: place(answer, low.at), high: most, there: place(answer, high.at) };
  return `${t("{name}: smallest {low} at {where}; largest {high} at {there}.", ends)}${open}`;
}
