/** A form for the options of a measurement, as the server lists them. */

import { h } from "../../dom.js";
import { choice } from "../../set_up/fields.js";
import { t, translated } from "../../words/language.js";

/**
 * Return `{element, options(), files()}` of a list of `{name, form, label, example, says, rare, choices}`;
 * `changed` is called after each change.
 */
export function measureForm(options, changed) {
  const values = {};
  const field = (option) => {
    const set = (value) => {
      values[option.name] = value;
      changed();
    };
    if (option.choices) return chooseField(option, set);
    return (FIELDS[option.form] ?? textField)(option, set);
  };
  const fieldsOf = (rare) => options.filter((one) => one.rare === rare).map(field);
  const element = h(
    "form",
    { class: "measure-options", "aria-label": t("What the file does not say"), autocomplete: "off" },
    fieldsOf(false),
    h("details", {}, h("summary", { text: t("More") }), h("div", { class: "measure-options" }, fieldsOf(true))),
  );
  element.addEventListener("submit", (event) => event.preventDefault());
  const given = (isFile) =>
    Object.fromEntries(Object.entries(values).filter(([, value]) => value !== "" && value instanceof File === isFile));
  return { element, options: () => given(false), files: () => given(true) };
}

const FIELDS = { flag: checkField, file: fileField };

function chooseField({ name, label, example, choices }, set) {
  const others = choices.filter((one) => one !== example).map((one) => [one, translated(one)]);
  return choice({ label: translated(label), groups: [["", [["", translated(example)], ...others]]], value: "", set, key: `option-${name}` });
}

function textField(option, set) {
  const text = { type: "text", placeholder: option.example, spellcheck: "false" };
  return labelledInput(option, { ...text, onchange: (event) => set(event.target.value.trim()) });
}

function checkField(option, set) {
  return labelledInput(option, { type: "checkbox", onchange: (event) => set(event.target.checked) });
}

function fileField(option, set) {
  return labelledInput(option, { type: "file", onchange: (event) => set(event.target.files[0] ?? "") });
}

function labelledInput({ name, label, says }, attributes) {
  return h("label", { class: "option", title: translated(says) }, h("span", { text: translated(label) }), h("input", { name, ...attributes }));
}
