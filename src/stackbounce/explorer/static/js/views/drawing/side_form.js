/** The choice of a number that varies, between which ends: for the sides of a map, and for a line. */

import { copyOf, partsOf, put, write } from "../../dom.js";
import { choice, sayProblem } from "../../set_up/fields.js";
import { t, translated } from "../../words/language.js";
import { firstSide, isSide } from "./sides.js";
import { capital, clean, format, pretty, read, shownUnit } from "../../words/words.js";

/**
 * Return the fields of a side: which number, between which ends, logarithmic or not.
 * @param {string} key begins the keys of its fields @param {() => object} current returns `{path, low, high, log}`
 */
export function sideForm(key, title, current, paths, set) {
  const side = current();
  const { element, legend, low, high, unit, log, problem } = partsOf(copyOf("side-parts"));
  const number = paths.find(({ path }) => path === side.path);
  const shown = shownUnit(number.unit);
  const change = (patch, text) => {
    const next = { ...current(), ...patch };
    const message = problemOf(next, text);
    sayProblem(problem, message, write);
    if (!message) set(next);
  };
  problem.id = `${key}-error`;
  write(legend, title);
  write(unit, pretty(shown.unit));
  const numbers = choice({
    label: t("{side}: parameter", { side: title }),
    quiet: true,
    key,
    groups: [["", paths.map(({ path, label }) => [path, capital(translated(label))])]],
    value: side.path,
    set: (path) => set(firstSide(paths.find((number) => number.path === path))),
  });
  legend.after(numbers);
  for (const [which, input] of Object.entries({ low, high })) {
    input.dataset.key = `${key}-${which}`;
    put(input, "aria-describedby", problem.id);
    input.defaultValue = format(clean(side[which] / shown.size), 6);
    input.addEventListener("change", () => change({ [which]: read(input.value, number.unit, shown) }, input.value));
  }
  log.dataset.key = `${key}-log`;
  log.checked = side.log;
  log.addEventListener("change", () => change({ log: log.checked }));
  return element;
}

function problemOf(side, text) {
  if (Number.isNaN(side.low + side.high)) return t("“{text}” is not a number.", { text });
  if (side.low === side.high) return t("The two ends must differ.");
  return isSide(side) ? null : t("A logarithmic axis needs limits above 0.");
}
