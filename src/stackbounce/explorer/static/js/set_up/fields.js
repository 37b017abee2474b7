/** One number of the drop: a label, a slider and a field that reads "57 g". */

import { h, write } from "../dom.js";
import { t, writeTold } from "../words/language.js";
import { clean, format, numeric, pretty, read, shownUnit, splitError } from "../words/units.js";
import { capital } from "../words/words.js";

const STEPS = 1000; // of a slider

/**
 * Return a field `{element, path, update(value), fail(message)}`.
 * @param {object} spec `{path, label, term, of, unit, low, high, large, says, optional, set(path, value, error), errorAt(path)}`;
 * with `errorAt` a text such as "63 ± 1 cm" has an error, which is null where none is typed
 */
export function numberField(spec) {
  const { path, unit, low, high } = spec;
  const label = spec.term ? `${spec.label} (${spec.term})` : spec.label;
  const spoken = spec.of ? t("{number} of {place}", { number: label, place: spec.of }) : label;
  const shown = shownUnit(unit, spec.large);
  const id = `field-${path.replaceAll(".", "-")}`;
  const ladder = scaleOf(low, high);
  const input = h("input", {
    id,
    class: "field-number",
    type: "text",
    inputmode: "decimal",
    autocomplete: "off",
    spellcheck: "false",
    "data-path": path,
    "aria-label": spoken,
    "aria-describedby": `${id}-unit ${id}-error`,
  });
  const slider = h("input", {
    class: "field-slider",
    type: "range",
    min: 0,
    max: STEPS,
    step: 1,
    "data-slider": path,
    "aria-label": t("{number}, slider", { number: spoken }),
  });
  const error = h("p", { class: "field-error", id: `${id}-error`, hidden: true });
  const help = spec.says ? explanation(spec.says, spec.term ?? spec.label, `${id}-says`) : null;
  const element = h(
    "div",
    { class: "field" },
    h("span", { class: "field-label" }, h("label", { for: id, text: label }), help?.button),
    h("span", { class: "field-box" }, input, h("span", { class: "unit", id: `${id}-unit`, text: pretty(shown.unit) })),
    slider,
    help?.text,
    error,
  );

  const place = (value) => {
    const si = numeric(value, unit);
    if (!Number.isFinite(si)) return;
    slider.value = ladder.toSlider(si);
    slider.setAttribute("aria-valuetext", `${format(si / shown.size)} ${pretty(shown.unit)}`);
  };
  const written = (value) => {
    const si = numeric(value, unit);
    if (!Number.isFinite(si)) return String(value ?? "");
    const error = spec.errorAt?.(path);
    const spread = typeof error === "number" ? ` ± ${format(clean(error / shown.size), 3)}` : error ? ` ± ${error}` : "";
    return format(clean(si / shown.size), 5) + spread;
  };
  let before = "";
  const show = (value) => {
    place(value);
    input.value = written(value);
    before = input.value;
  };
  let shownNow = []; // value, error and whether somebody types: of many fields few change
  const update = (value) => {
    const next = [value, spec.errorAt?.(path), document.activeElement === input];
    if (next.every((one, i) => one === shownNow[i]) && shownNow.length) return;
    shownNow = next;
    place(value);
    element.classList.toggle("uncertain", Boolean(next[1]));
    if (!next[2]) show(value);
  };
  const commit = () => {
    if (input.value === before) return; // the shown value may be rounded
    before = input.value;
    if (spec.optional && input.value.trim() === "") spec.set(path, undefined);
    else spec.set(path, ...typed());
  };
  const typed = () => {
    const { value, error } = spec.errorAt ? splitError(input.value) : { value: input.value, error: null };
    return [read(value, unit, shown), error === null ? null : read(error, unit, shown)];
  };
  slider.addEventListener("input", () => {
    const value = ladder.toValue(Number(slider.value));
    show(value);
    spec.set(path, value);
  });
  input.addEventListener("change", () => {
    commit();
    const [value] = typed();
    if (typeof value === "number") show(value);
  });
  input.addEventListener("keydown", (event) => {
    const up = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (event.key === "Enter") event.preventDefault();
    if (event.key === "Enter") commit();
    if (!up) return;
    event.preventDefault();
    const value = ladder.toValue(Number(slider.value) + 5 * up);
    show(value);
    spec.set(path, value);
  });
  let told; // the message that is shown
  const fail = (message) => {
    if (message === told) return;
    told = message;
    writeTold(error, message ?? "");
    write(error, capital(error.textContent));
    error.hidden = !message;
    input.setAttribute("aria-invalid", message ? "true" : "false");
  };
  return { element, path, update, fail };
}

/** Return `{button, text}`: an explanation that a button shows and hides. */
function explanation(says, what, id) {
  const text = h("p", { class: "note", id, text: says, hidden: true });
  const toggle = () => {
    text.hidden = !text.hidden;
    button.setAttribute("aria-expanded", String(!text.hidden));
  };
  const about = { class: "explain", "aria-label": t("What is {what}?", { what }), "aria-expanded": "false", "aria-controls": id };
  const button = h("button", { type: "button", ...about, text: "?", onclick: toggle });
  return { button, text };
}

/** Return how a slider's steps become values: by factors over a wide range, else evenly. */
function scaleOf(low, high) {
  const wide = low > 0 && high / low > 15;
  const step = high - low;
  return {
    toValue(place) {
      const part = Math.min(Math.max(place / STEPS, 0), 1);
      return clean(Number((wide ? low * (high / low) ** part : low + step * part).toPrecision(3)));
    },
    toSlider(value) {
      const part = wide ? Math.log(Math.max(value, low) / low) / Math.log(high / low) : (value - low) / step;
      return Math.round(STEPS * Math.min(Math.max(part, 0), 1));
    },
  };
}

/** Return a labelled choice; `groups` is a list of `[title, [[value, text], …]]`, without title for none. */
export function choice({ label, groups, value, set, quiet, key }) {
  const options = groups.map(([title, entries]) => {
    const list = entries.map(([entry, text]) => h("option", { value: entry, text, selected: entry === value }));
    return title ? h("optgroup", { label: title }, list) : list;
  });
  const select = h("select", { "data-key": key, onchange: (event) => set(event.target.value) }, options);
  return h("label", { class: "choice" }, h("span", { class: quiet ? "quiet" : "choice-label", text: label }), select);
}
