/** The choice of a number that varies, between which ends: for the sides of a map, and for a line. */

import { h, write } from "../../dom.js";
import { check, choice, sayProblem } from "../../set_up/fields.js";
import { t, translated } from "../../words/language.js";
import { firstSide, isSide } from "./axes.js";
import { clean, format, pretty, read, shownUnit } from "../../words/units.js";
import { capital } from "../../words/words.js";

/**
 * Return the fields of a side: which number, between which ends, logarithmic or not.
 * @param {string} key begins the keys of its fields @param {() => object} current returns `{path, low, high, log}`
 */
export function sideForm(key, title, current, paths, set) {
  const side = current();
  const problem = h("p", { class: "field-error", role: "alert", id: `${key}-error`, hidden: true });
  const { unit } = paths.find(({ path }) => path === side.path);
  const shown = shownUnit(unit);
  const change = (patch) => {
    const next = { ...current(), ...patch };
    const message = problemOf(next);
    sayProblem(problem, message, write);
    if (!message) set(next);
  };
  const end = (which, label) => {
    const input = h("input", {
      type: "text",
      inputmode: "decimal",
      class: "field-number",
      "data-key": `${key}-${which}`,
      "aria-describedby": problem.id,
      value: format(clean(side[which] / shown.size), 6),
      onchange: () => change({ [which]: read(input.value, unit, shown) }),
    });
    return h("label", { class: "side-end" }, h("span", { text: label }), input);
  };
  return h(
    "fieldset",
    {},
    h("legend", { text: title }),
    choice({
      label: t("{side}: parameter", { side: title }),
      quiet: true,
      key,
      groups: [["", paths.map(({ path, label }) => [path, capital(translated(label))])]],
      value: side.path,
      set: (path) => set(firstSide(paths.find((number) => number.path === path))),
    }),
    h(
      "div",
      { class: "side-ends" },
      end("low", t("from")),
      end("high", t("to")),
      h("span", { class: "unit", text: pretty(shown.unit) }),
      check(t("logarithmic"), side.log, (log) => change({ log }), { "data-key": `${key}-log` }),
    ),
    problem,
  );
}

function problemOf(side) {
  const text = [side.low, side.high].find((end) => typeof end !== "number");
  if (text !== undefined) return t("“{text}” is not a number.", { text });
  if (side.low === side.high) return t("The two ends must differ.");
  return isSide(side) ? null : t("A logarithmic axis needs limits above 0.");
}
