/** Where a file comes in: a button, the whole view as a place to drop it, examples for a try. */

import { h } from "../../dom.js";
import { EXAMPLES } from "./examples.js";
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
  const problem = h("p", { class: "field-error", role: "alert", hidden: true });
  const example = async ({ file, drop }) => {
    problem.hidden = true;
    try {
      const answer = await fetch(`examples/${file}`);
      if (!answer.ok) throw new Error(t("{file} could not be loaded.", { file }));
      take(new File([await answer.blob()], file, { type: "text/csv" }), drop);
    } catch (error) {
      problem.textContent = error.message;
      problem.hidden = false;
    }
  };
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
  return h(
    "div",
    { class: "file-drop" },
    h("h2", { id: "measure-title", text: t("Bring your own measurement") }),
    h(
      "p",
      { class: "note" },
      t(
        "A sound, a force, a video’s track, an acceleration, times or heights of bounces, or a press curve, as Tracker, ImageJ, phyphox, oscilloscopes or spreadsheets write it. It stays on this machine.",
      ),
    ),
    h(
      "div",
      { class: "drop-zone" },
      h("button", { type: "button", class: "primary", text: t("Choose a file"), onclick: () => input.click() }),
      h("span", { text: t("or drop it here") }),
      input,
    ),
    microphone(take),
    h(
      "details",
      { class: "examples", open: true },
      h("summary", { text: t("Or try an example") }),
      EXAMPLES.map((one) =>
        h(
          "div",
          { class: "example" },
          h("button", { type: "button", text: one.title, onclick: () => example(one) }),
          h("p", { class: "note", text: one.says }),
        ),
      ),
    ),
    problem,
  );
}
