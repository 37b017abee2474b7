/** What a file does not say: options that are sent with it. */

import { h } from "./dom.js";
import { choice } from "./fields.js";

const KINDS = ["sound", "knocks", "bounces", "track", "waveform", "acceleration", "press curve", "table"];

/** The options that are typed: name, what it is called, an example, what it does. */
const FIRST = [
  ["mass", "Ball’s mass", "57 ± 0.5 g", "Makes a stiffness of a contact time."],
  ["diameter", "Diameter", "66 mm", "Needed where heights are not those of the ball’s lowest point."],
  ["height", "Drop height", "1.00 ± 0.01 m", "Gives the restitution of the first bounce."],
  ["speed", "Impact speed", "3.5 m/s", "Calibrates the impulse of a force."],
  ["names", "Columns", "1=time, 2=force", "What a column is, by its name or its number from 1."],
  ["units", "Units of columns", "x=cm, y=cm", "Where the file tells none."],
];
const MORE = [
  ["restitution", "Restitution", "0.75 ± 0.02", "Of the lowest ball alone, where no file tells it."],
  ["contact_time", "Contact time", "5.0 ± 0.1 ms", "Of the lowest ball alone, where no file tells it."],
  ["height_error", "Error of heights", "5 mm", "Of each height of a table."],
  ["floor", "Level of the floor", "0 m", "In a track, for a ball that stays on it for long."],
  ["time_constant", "Sensor’s time constant", "0.1 s", "Of a piezo sensor’s droop, which is then undone."],
  ["gravity", "Gravity", "9.81 m/s^2", "Where it was measured."],
  ["table", "Table", "Energy", "Which one of a zip."],
  ["run", "Run", "2", "Which of several in the file."],
];

/** Return `{element, options()}`; `changed` is called after each change, `catalogue` is the server's to come. */
export function measureForm(changed, catalogue) {
  const values = {};
  const set = (name) => (value) => {
    values[name] = value;
    changed();
  };
  const typed = ([name, label, example, says]) =>
    h(
      "label",
      { class: "option", title: says },
      h("span", { text: label }),
      h("input", {
        type: "text",
        placeholder: example,
        spellcheck: "false",
        onchange: (event) => set(name)(event.target.value.trim()),
      }),
    );
  const chosen = (name, label, entries) =>
    choice({ label, groups: [["", entries]], value: "", set: set(name), key: `option-${name}` });
  const plain = (list) => list.map((entry) => [entry, entry]);
  const law = chosen("law", "Contact law", [["", "none in particular"]]);
  catalogue.then(({ laws }) => law.querySelector("select").append(...laws.map((one) => h("option", { value: one.law, text: one.law }))));
  const element = h(
    "form",
    { class: "measure-options", "aria-label": "What the file does not say", autocomplete: "off" },
    chosen("holds", "It holds", [["", "as recognised"], ...plain(KINDS)]),
    FIRST.map(typed),
    law,
    chosen("measured_to", "Heights are those of the ball’s", [["", "lowest point"], ...plain(["centre", "top"])]),
    h("details", {}, h("summary", { text: "More" }), h("div", { class: "measure-options" }, MORE.map(typed))),
  );
  element.addEventListener("submit", (event) => event.preventDefault());
  return { element, options: () => optionsOf(values) };
}

/** Return the options as the server takes them; throws an Error that says what cannot be read. */
function optionsOf(values) {
  const found = {};
  for (const [name, value] of Object.entries(values)) {
    if (value === "") continue;
    found[name] = name === "names" || name === "units" ? pairs(value) : value;
  }
  return found;
}

function pairs(text) {
  const parts = text.split(",").map((part) => part.split("=").map((side) => side.trim()));
  const wrong = parts.find((part) => part.length !== 2 || part.includes(""));
  if (wrong) throw new Error(`Columns are told as COLUMN=MEANING, such as 2=force, got “${wrong.join("=")}”.`);
  return Object.fromEntries(parts);
}
