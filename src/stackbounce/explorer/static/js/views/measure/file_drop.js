/** Where a file comes in: a button, the whole view as a place to drop it, examples for a try. */

import { button, h, write } from "../../dom.js";
import { EXAMPLES } from "./examples.js";
import { problemLine } from "../../set_up/fields.js";
import { t } from "../../words/language.js";
import { microphone } from "./microphone.js";

/** Return the element; `take` hears each file, and the drop of an example. */
export function fileDrop(root, take) {
  const input = h("input", {
    type: "file",
    hidden: true,
    onchange: () => {
      if (input.files[0]) take(input.files[0]);
      input.value = "";
    },
  });
  const problem = problemLine(write);
  const load = async ({ file, drop }) => {
    problem.show();
    try {
      const answer = await fetch(`examples/${file}`);
      if (!answer.ok) throw new Error(t("{file} could not be loaded.", { file }));
      take(new File([await answer.blob()], file, { type: "text/csv" }), drop);
    } catch (error) {
      problem.show(error.message);
    }
  };
  const kinds = t(
    "A sound, a force, a video’s track, an acceleration, times or heights of bounces, or a press curve, as Tracker, ImageJ, phyphox, oscilloscopes or spreadsheets write it. It stays on this machine.",
  );
  const choose = button(t("Choose a file"), () => input.click(), { class: "primary" });
  const entry = (example) => h("div", { class: "example" }, button(example.title, () => load(example)), h("p", { class: "note", text: example.says }));
  letDrop(root, take);
  return h(
    "div",
    { class: "file-drop" },
    h("h2", { id: "measure-title", text: t("Bring your own measurement") }),
    h("p", { class: "note", text: kinds }),
    h("div", { class: "drop-zone" }, choose, h("span", { text: t("or drop it here") }), input),
    microphone(take),
    h("details", { class: "examples", open: true }, h("summary", { text: t("Or try an example") }), EXAMPLES.map(entry)),
    problem.element,
  );
}

/** Let files be dropped anywhere in the view. */
function letDrop(root, take) {
  for (const name of ["dragenter", "dragover"]) {
    root.addEventListener(name, (event) => {
      event.preventDefault();
      root.classList.add("dropping");
    });
  }
  root.addEventListener("dragleave", (event) => {
    if (!root.contains(event.relatedTarget)) root.classList.remove("dropping");
  });
  root.addEventListener("drop", (event) => {
    event.preventDefault();
    root.classList.remove("dropping");
    if (event.dataTransfer.files[0]) take(event.dataTransfer.files[0]);
  });
}
