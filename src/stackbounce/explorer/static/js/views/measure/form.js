/** A form for the options of a measurement, as the server lists them. */

import { h } from "../../dom.js";
import { choice } from "../../set_up/fields.js";
import { translated } from "../../words/language.js";
import { pointed } from "../../words/words.js";

/**
 * Fill the form of `parts` with a list of options `{name, form, label, example, says, rare, choices}`; returns `{options()}`.
 * `changed` is called after each change.
 */
export function measureForm({ options: form, more, rare }, options, changed) {
  const values = {};
  const field = (option) => {
    const set = (value) => {
      values[option.name] = value;
      changed();
    };
    return option.choices ? chooseField(option, set) : inputField(option, set);
  };
  more.before(...options.filter((option) => !option.rare).map(field));
  rare.append(...options.filter((option) => option.rare).map(field));
  form.addEventListener("submit", (event) => event.preventDefault());
  return { options: () => Object.fromEntries(Object.entries(values).filter(([, value]) => value !== "")) };
}

function chooseField({ name, label, example, choices }, set) {
  const others = choices.filter((value) => value !== example).map((value) => [value, translated(value)]);
  return choice({ label: translated(label), groups: [["", [["", translated(example)], ...others]]], value: "", set, key: `option-${name}` });
}

function inputField({ name, form, label, says, example }, set) {
  const attributes = form === "flag" ? { type: "checkbox" } : { type: "text", placeholder: example, spellcheck: "false" };
  const input = h("input", { name, ...attributes, onchange: () => set(form === "flag" ? input.checked : pointed(input.value.trim())) });
  return h("label", { class: "option", title: translated(says) }, h("span", { text: translated(label) }), input);
}
