/** The choices of a line: a figure of the paper, what lies across, and what is shown. */

import { h } from "../../dom.js";
import { choice } from "../../set_up/fields.js";
import { t, translated } from "../../words/language.js";
import { drawingForm } from "../drawing/form.js";
import { sideForm } from "../drawing/side_form.js";
import { SHOWS } from "./in_words.js";

/**
 * Fill the form in an element, as `drawingForm` does.
 * @param {object[]} figures the paper's lines @param {(answer: object) => object} figureOf which of them an answer is
 * @param {object} heard `set(settings)` and `use(figure)`
 */
export function lineForm(element, figures, figureOf, { set, use }) {
  const figureIn = ({ answer }) => answer && figureOf(answer);
  const fill = (news, { current, change }) => {
    const { settings, paths, unfit } = news;
    const figure = figureIn(news);
    return [
      choice({
        label: t("Curves of the paper"),
        key: "line-figure",
        groups: [["", [["", t("Choose a figure")], ...figures.map(({ name, title }) => [name, translated(title)])]]],
        value: figure?.name ?? "",
        set: (name) => use(figures.find((known) => known.name === name)),
      }),
      h("p", { class: "note", text: [wordsOf(unfit), translated(figure?.says)].filter(Boolean).join(" ") }),
      choice({
        label: t("Shown"),
        key: "line-show",
        groups: [["", [...SHOWS]]],
        value: settings.show,
        set: (show) => change({ show }),
      }),
      sideForm("line-x", t("Across"), () => current().x, paths, (x) => change({ x })),
    ];
  };
  const extra = (news) => [news.unfit, figureIn(news)?.name];
  return drawingForm(element, { name: "line", extra, fill }, set);
}

/** Name what the wanted settings have that this drop has not. */
function wordsOf(unfit) {
  if (!unfit.length) return "";
  const names = unfit.map((name) => `“${name.slice(0, 40)}”`).join(", ");
  return t("This drop has no {names}: something else is shown.", { names });
}
