/** The map: how a number of the outcome depends on two numbers of the drop. */

import { scaleOfColors } from "../../plots/colors.js";
import { brief, extremes, quantity, sideOf } from "../drawing/sides.js";
import { drawer } from "../drawing/request.js";
import { DrawingView } from "../drawing/view.js";
import { t, translated } from "../../words/language.js";
import { drawMap, drawMarks } from "./draw.js";
import { mapForm } from "./form.js";
import { mapOf, settle } from "./request.js";
import { palette } from "../../plots/palette.js";
import { capital, count } from "../../words/words.js";

/** Build the view into `root`. */
export function mount(root, store, api, clock) {
  new DrawingView(root, store, clock, {
    name: "map",
    role: t("map"),
    here: t("The cross is the present drop."),
    outside: t("The present drop lies outside of this map."),
    sides: 2,
    margin: 0,
    step: 1 / 60,
    form: (element) => mapForm(element, (map) => store.set({ map })),
    requests: (tell) => drawer(api, tell, settle, (...asked) => mapOf(api, ...asked)),
    sidesOf,
    draw(_size, { answer: english, settings }, { drawing }) {
      const answer = inOurLanguage(english);
      const { label, x, y } = answer;
      const isCount = answer.show.startsWith("collisions");
      return {
        frame: drawMap(drawing, answer, settings, scaleOfColors(answer.values, isCount), palette()),
        title: capital(label),
        label: t("Map: {what}; across, {x}; up, {y}", { what: label, x: x.label, y: y.label }),
        summary: summary(answer),
      };
    },
    mark: (_news, present, pointed, { marks }) => drawMarks(marks, present, pointed, palette()),
    told: toldAt,
  });
}

function sidesOf({ settings: { x, y } }) {
  return [x, y];
}

/** Return the nearest outcome to a place in words. */
function toldAt(news, [x, y]) {
  const answer = inOurLanguage(news.answer);
  const { values } = answer;
  const nearest = (part, count) => Math.round(part * (count - 1));
  const value = values[nearest(y, values.length)][nearest(x, values[0].length)];
  const [across, up] = sidesOf(news);
  return `${capital(placeOf(answer, [sideOf(across).value(x), sideOf(up).value(y)]))}: ${outcome(answer, value)}.`;
}

/** Return a map with its labels, which the engine has in English, in the page's language. */
function inOurLanguage(answer) {
  const side = (axis) => ({ ...axis, label: translated(axis.label) });
  return { ...answer, label: translated(answer.label), x: side(answer.x), y: side(answer.y) };
}

/** Return what an outcome is at a point, in words. */
function outcome({ show, unit }, value) {
  if (value === null) return t("not finished");
  return show.startsWith("collisions") ? count(value) : quantity(value, unit);
}

/** Return a point `[x, y]` of two values in words. */
function placeOf({ x, y }, point) {
  return `${brief(x.label)} ${quantity(point[0], x.unit)}, ${brief(y.label)} ${quantity(point[1], y.unit)}`;
}

/** Return what a map shows as a whole: its ends and where they are. */
function summary(answer) {
  const { x, y, label, unfinished } = answer;
  const values = answer.values.flat();
  const [low, high] = extremes(values, answer.show.startsWith("collisions"));
  if (low === null) return t("No point of this map could be finished.");
  const open = unfinished ? ` ${t("{some} of {all} points, hatched, could not be finished.", { some: unfinished, all: values.length })}` : "";
  const [least, most] = [low, high].map((i) => outcome(answer, values[i]));
  const name = capital(label);
  if (least === most) return `${t("{name}: {value} everywhere.", { name, value: least })}${open}`;
  const at = (i) => placeOf(answer, [x.values[i % x.values.length], y.values[Math.floor(i / x.values.length)]]);
  return `${t("{name}: smallest {low} at {where}; largest {high} at {there}.", { name, low: least, where: at(low), high: most, there: at(high) })}${open}`;
}
