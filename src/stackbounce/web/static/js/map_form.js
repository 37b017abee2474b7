/** The choices of a map: what lies along its sides, between which ends, and what it shows. */

import { h, write } from "./dom.js";
import { choice } from "./fields.js";
import { firstSide, isSide } from "./map_axes.js";
import { depends } from "./map_words.js";
import { clean, format, pretty, read, shownUnit } from "./units.js";
import { capital } from "./words.js";

/** Return `{element, update({settings, paths, shows})}`; `set` hears the new settings. */
export function mapForm(set) {
  const element = h("form", { class: "map-form", "aria-label": "What the map shows", autocomplete: "off" });
  element.addEventListener("submit", (event) => event.preventDefault());
  let shown = "";
  const update = ({ settings, paths, shows }) => {
    const now = JSON.stringify([settings, paths.map(({ path, label }) => [path, label]), shows]);
    if (now === shown) return;
    shown = now;
    const focused = document.activeElement?.dataset?.key;
    let latest = settings; // a second choice may come before the first one is answered
    const change = (patch) => set((latest = { ...latest, ...patch }));
    const other = { x: settings.y.path, y: settings.x.path };
    const free = (name) => paths.filter(({ path }) => !depends(path, other[name]));
    const side = (name, title) => sideForm(name, title, () => latest[name], free(name), (next) => change({ [name]: next }));
    element.replaceChildren(
      choice({
        label: "Colour shows",
        key: "map-show",
        groups: [["", shows.map(({ show, label }) => [show, capital(label)])]],
        value: settings.show,
        set: (show) => change({ show }),
      }),
      side("x", "Across"),
      side("y", "Up"),
      h("button", {
        type: "button",
        text: "Swap sides",
        "data-key": "map-swap",
        onclick: () => change({ x: latest.y, y: latest.x }),
      }),
    );
    if (focused?.startsWith("map-")) element.querySelector(`[data-key="${CSS.escape(focused)}"]`)?.focus();
  };
  return { element, update };
}

function sideForm(name, title, current, paths, set) {
  const side = current();
  const error = h("p", { class: "field-error", id: `map-${name}-error`, role: "alert", hidden: true });
  const { unit } = paths.find(({ path }) => path === side.path);
  const shown = shownUnit(unit);
  const change = (patch) => {
    const next = { ...current(), ...patch };
    const problem = problemOf(next);
    error.hidden = !problem;
    write(error, problem ?? "");
    if (!problem) set(next);
  };
  const end = (which, label) => {
    const input = h("input", {
      type: "text",
      inputmode: "decimal",
      class: "field-number",
      "data-key": `map-${name}-${which}`,
      "aria-describedby": error.id,
      value: format(clean(side[which] / shown.size), 6),
      onchange: () => change({ [which]: read(input.value, unit, shown) }),
    });
    return h("label", { class: "map-end" }, h("span", { text: label }), input);
  };
  const log = h("input", {
    type: "checkbox",
    checked: side.log,
    "data-key": `map-${name}-log`,
    onchange: (event) => change({ log: event.target.checked }),
  });
  return h(
    "fieldset",
    {},
    h("legend", { text: title }),
    choice({
      label: `${title}: parameter`,
      quiet: true,
      key: `map-${name}`,
      groups: [["", paths.map(({ path, label }) => [path, capital(label)])]],
      value: side.path,
      set: (path) => set(firstSide(paths.find((one) => one.path === path))),
    }),
    h(
      "div",
      { class: "map-ends" },
      end("low", "from"),
      end("high", "to"),
      h("span", { class: "unit", text: pretty(shown.unit) }),
      h("label", { class: "check" }, log, "logarithmic"),
    ),
    error,
  );
}

function problemOf(side) {
  const text = [side.low, side.high].find((end) => typeof end !== "number");
  if (text !== undefined) return `“${text}” is not a number.`;
  if (side.low === side.high) return "The two ends must differ.";
  return isSide(side) ? null : "A logarithmic axis needs limits above 0.";
}
