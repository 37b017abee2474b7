/** The elements of a view that shows one drawing, with a stage beside it: a line or a map. */

import { button, h } from "../../dom.js";
import { t } from "../../words/language.js";
import { capital } from "../../words/words.js";

const NAMES = { line: t("line"), map: t("map") };

/** Return the elements of a view by what they are; their classes begin with its name, `drawing` has `marks` on top. */
export function drawingParts({ name, keys: keysText, drawing, marks }) {
  const named = (part) => `${name}-${part}`;
  const board = h(
    "div",
    {
      class: named("board"),
      tabindex: "0",
      role: "application",
      "aria-roledescription": NAMES[name],
      "aria-label": capital(NAMES[name]),
      "aria-describedby": `${named("keys")} ${named("summary")}`,
    },
    drawing,
    marks,
  );
  const title = h("h2", { class: named("title") });
  const readout = h("p", { class: named("readout") });
  const play = button(t("Play this drop"), null, { class: named("play"), hidden: true });
  const live = h("p", { class: "quiet", "aria-live": "polite" });
  const message = h("p", { class: named("message"), role: "status" });
  const again = button(t("Try again"), null, { hidden: true });
  const summary = h("p", { class: "note", id: named("summary") });
  const keys = h("p", { class: "quiet", id: named("keys"), text: keysText });
  const box = h("div", { class: named("box") }, board, h("div", { class: named("over") }, message, again));
  const figure = h("section", { class: named("figure"), "aria-label": capital(NAMES[name]) }, title, readout, play, box, keys, live);
  const stage = h("div", { class: `stage ${named("stage")}` });
  const told = h("p", { class: named("told") });
  return { stage, told, figure, board, title, readout, play, live, message, again, summary };
}
