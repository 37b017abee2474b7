/** The map: how a number of the outcome depends on two numbers of the drop. */

import { scaleOfColors } from "../../plots/colors.js";
import { sideOf } from "../drawing/axes.js";
import { DrawingView } from "../drawing/view.js";
import { t, translated } from "../../words/language.js";
import { drawMap, drawMarks } from "./draw.js";
import { mapForm } from "./form.js";
import { mapper } from "./request.js";
import { outcome, place, summary } from "./in_words.js";
import { palette } from "../../plots/palette.js";
import { capital } from "../../words/words.js";

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
    form: mapForm((map) => store.set({ map })),
    requests: (tell) => mapper(api, tell),
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
  return `${capital(place(answer, [sideOf(across).value(x), sideOf(up).value(y)]))}: ${outcome(answer, value)}.`;
}

/** Return a map with its labels, which the engine has in English, in the page's language. */
function inOurLanguage(answer) {
  const side = (axis) => ({ ...axis, label: translated(axis.label) });
  return { ...answer, label: translated(answer.label), x: side(answer.x), y: side(answer.y) };
}
