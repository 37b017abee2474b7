/** One number of the drop: a label, a slider and a field that reads "57 g". */

import { copyOf, h, partsOf, put, write } from "../dom.js";
import { t, writeTold } from "../words/language.js";
import { BOUNDS } from "./drops.js";
import { capital, clean, format, formatMeasured, pretty, read, shownUnit, splitError } from "../words/words.js";

const STEPS = 1000; // of a slider, as its HTML has them

export class NumberField {
  /**
   * @param {object} spec `{path, label, term, of, unit, low, high, bounds, large, says, optional, usual, useless, set(path, value, error),
   * errorAt(path), follow(value)}`; `usual` stands for none, and `useless` says why there is nothing to set; with `errorAt` a text such as "63 ± 1 cm" has an error, which is null where none is typed; `bounds` are
   * by default those of the path
   */
  constructor(spec) {
    const { path, unit, low, high } = spec;
    Object.assign(this, { spec, path, shown: shownUnit(unit, spec.large), scale: scaleOf(low, high) });
    this.bounds = spec.bounds ?? path.split(".").map((part) => BOUNDS[part]).find(Boolean);
    this.written = ""; // what the input has been given
    this.latest = []; // value, error and whether somebody types: of many fields few change
    this.build(spec);
    this.input.addEventListener("change", () => this.commit());
    this.input.addEventListener("input", () => this.fail(null));
    this.input.addEventListener("keydown", (event) => this.press(event));
    this.slider.addEventListener("input", () => this.slide(Number(this.slider.value)));
  }

  build({ path, term, label: word, of, says, useless }) {
    const name = term ? `${word} (${term})` : word;
    const spoken = of ? t("{number} of {place}", { number: name, place: of }) : name;
    const id = `field-${path.replaceAll(".", "-")}`;
    const { element, label, input, unit, slider, error, explain, note } = partsOf(copyOf("field-parts"));
    Object.assign(this, { element, input, slider, error });
    input.id = id;
    input.dataset.path = path;
    put(input, "aria-label", spoken);
    put(input, "aria-describedby", `${id}-unit ${id}-error`);
    Object.assign(label, { htmlFor: id, textContent: name });
    Object.assign(unit, { id: `${id}-unit`, textContent: pretty(this.shown.unit) });
    put(slider, "aria-label", t("{number}, slider", { number: spoken }));
    slider.dataset.slider = path;
    error.id = `${id}-error`;
    for (const control of [input, slider]) control.disabled = Boolean(useless);
    if (useless) Object.assign(note, { textContent: useless, hidden: false });
    if (useless) explain.remove();
    else if (says) explainBy(explain, note, says, term ?? word, `${id}-says`);
    else for (const part of [explain, note]) part.remove();
  }

  /** Follow a value of the drop, which somebody may be typing. */
  update(value = this.spec.usual) {
    const next = [value, this.spec.errorAt?.(this.path), document.activeElement === this.input];
    if (this.latest.length && next.every((part, i) => part === this.latest[i])) return;
    this.latest = next;
    this.place(value);
    this.element.classList.toggle("uncertain", Boolean(next[1]));
    if (!next[2]) this.show(value);
    this.spec.follow?.(value);
  }

  show(value) {
    this.place(value);
    this.input.value = this.textOf(value);
    this.written = this.input.value;
  }

  /** Put the slider where a value is. */
  place(value) {
    this.value = value;
    if (value === undefined) return;
    this.slider.value = this.scale.toSlider(value);
    this.slider.setAttribute("aria-valuetext", `${format(value / this.shown.size)} ${pretty(this.shown.unit)}`);
  }

  /** Return a value with its error as it is written. */
  textOf(value) {
    if (value === undefined) return "";
    const { size } = this.shown;
    const error = this.spec.errorAt?.(this.path);
    return format(clean(value / size), 5) + (error ? ` ± ${format(clean(error / size), 3)}` : "");
  }

  /** Return the value and the error that are typed. */
  typed() {
    const { unit, errorAt } = this.spec;
    const { value, error } = errorAt ? splitError(this.input.value) : { value: this.input.value, error: null };
    return [value, error].map((text) => (text === null ? null : read(text, unit, this.shown)));
  }

  /** Take what is typed; what the page does not take is said, and the number before stays. */
  commit() {
    const text = this.input.value;
    if (text === this.written) return; // the shown value may be rounded
    if (this.spec.optional && text.trim() === "") {
      this.spec.set(this.path, undefined);
      return;
    }
    const [value, error] = this.typed();
    const [least, most] = this.bounds;
    if (value >= least && value <= most && (error === null || error >= 0)) {
      this.fail(null);
      this.spec.set(this.path, value, error);
      this.show(value);
      return;
    }
    const [low, high] = this.bounds.map((end) => (end === 0 ? "0" : formatMeasured(end, null, this.spec.unit)));
    this.show(this.value);
    this.fail(t("“{text}” cannot be used, the number before stays: it is from {low} to {high}.", { text, low, high }));
  }

  press(event) {
    const way = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (way || event.key === "Enter") event.preventDefault();
    if (event.key === "Enter") this.commit();
    if (way) this.slide(Number(this.slider.value) + 5 * way);
  }

  slide(step) {
    const value = this.scale.toValue(step);
    this.fail(null);
    this.show(value);
    this.spec.set(this.path, value);
  }

  /** Say what is wrong with the value, or that nothing is. */
  fail(message) {
    if (message === this.message) return;
    this.message = message;
    writeTold(this.error, message ?? "");
    write(this.error, capital(this.error.textContent));
    this.error.hidden = !message;
    put(this.input, "aria-invalid", Boolean(message));
  }
}

/** Let a button show and hide an explanation. */
function explainBy(button, note, says, what, id) {
  Object.assign(note, { id, textContent: says });
  button.textContent = "?";
  put(button, "aria-label", t("What is {what}?", { what }));
  put(button, "aria-controls", id);
  button.addEventListener("click", () => {
    note.hidden = !note.hidden;
    put(button, "aria-expanded", !note.hidden);
  });
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

/** Say an error in its line, which is hidden without one; `tell` writes it. */
export function sayProblem(line, message = null, tell = writeTold) {
  tell(line, message ?? "");
  line.hidden = !message;
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
