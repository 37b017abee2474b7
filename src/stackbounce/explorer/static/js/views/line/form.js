/** The choices of a line: a figure of the paper, what lies across, and what is shown. */

import { h, write } from "../../dom.js";
import { choice } from "../../set_up/fields.js";
import { t, translated } from "../../words/language.js";
import { SHOWS } from "./in_words.js";
import { patient, sideForm } from "../side_form.js";

/**
 * Return `{element, update({settings, paths, unfit, figure, notice})}`.
 * @param {object[]} figures the paper's lines @param {object} heard `set(settings)`, `use(figure)` and `save(kind)`
 */
export function lineForm(figures, { set, use, save }) {
  const element = h("form", { class: "view-form line-form", "aria-label": t("What the line shows"), autocomplete: "off" });
  const says = h("p", { class: "note" });
  element.addEventListener("submit", (event) => event.preventDefault());
  let shown = "";
  const update = ({ settings, paths, unfit, figure }) => {
    write(says, [wordsOf(unfit), translated(figure?.says)].filter(Boolean).join(" "));
    const now = JSON.stringify([settings, paths.map(({ path, label }) => [path, label]), figure?.name]);
    if (now === shown) return;
    shown = now;
    const focused = document.activeElement?.dataset?.key;
    let latest = settings; // a second choice may come before the first one is answered
    const change = (patch) => {
      const other = patch.x && patch.x.path !== latest.x.path;
      set((latest = { ...latest, ...patch }));
      if (other) update({ settings: latest, paths, unfit: [] }); // its ends are of another unit
    };
    element.replaceChildren(
      choice({
        label: t("Curves of the paper"),
        key: "line-figure",
        groups: [["", [["", t("Choose a figure")], ...figures.map(({ name, title }) => [name, translated(title)])]]],
        value: figure?.name ?? "",
        set: (name) => use(figures.find((one) => one.name === name)),
      }),
      says,
      choice({
        label: t("Shown"),
        key: "line-show",
        groups: [["", [...SHOWS]]],
        value: settings.show,
        set: (show) => change({ show }),
      }),
      sideForm("line-x", t("Across"), () => latest.x, paths, (x) => change({ x })),
      h("div", { class: "line-save", role: "group", "aria-label": t("Save the line") }, KINDS.map(([kind, text]) => saver(kind, text, save))),
    );
    if (focused?.startsWith("line-")) element.querySelector(`[data-key="${CSS.escape(focused)}"]`)?.focus();
  };
  return { element, update: patient(element, update) };
}

const KINDS = [
  ["csv", t("Save CSV")],
  ["svg", "SVG"],
  ["png", "PNG"],
];

function saver(kind, text, save) {
  return h("button", { type: "button", class: "small", "data-key": `line-save-${kind}`, text, onclick: () => save(kind) });
}

/** Name what the wanted settings have that this drop has not. */
function wordsOf(unfit) {
  if (!unfit.length) return "";
  const names = unfit.map((name) => `“${name.slice(0, 40)}”`).join(", ");
  return t("This drop has no {names}: something else is shown.", { names });
}
