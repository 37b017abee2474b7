/** Where a file comes in: a button, the whole view as a place to drop it, examples for a try. */

import { partsOf, write } from "../../dom.js";
import { EXAMPLES } from "./examples.js";
import { sayProblem } from "../../set_up/fields.js";
import { t } from "../../words/language.js";
import { microphone } from "./microphone.js";

/** Let files come in by the parts of `root`; `take` hears each of them, and the drop of an example. */
export function fileDrop(root, take) {
  const { choose, input, exampleProblem: problem } = partsOf(root);
  choose.addEventListener("click", () => input.click());
  input.addEventListener("change", () => {
    if (input.files[0]) take(input.files[0]);
    input.value = "";
  });
  const load = async (file) => {
    sayProblem(problem);
    try {
      const answer = await fetch(file);
      if (!answer.ok) throw new Error(t("{file} could not be loaded.", { file }));
      take(new File([await answer.blob()], file, { type: "text/csv" }), EXAMPLES[file]);
    } catch (error) {
      sayProblem(problem, error.message, write);
    }
  };
  for (const example of root.querySelectorAll("[data-example]")) example.addEventListener("click", () => load(example.dataset.example));
  microphone(root, take);
}

/** Show where a file can be dropped: anywhere in the view. What is dropped anywhere on the page is taken as `dropped.js` says. */
export function showDropping(root) {
  for (const name of ["dragenter", "dragover"]) {
    root.addEventListener(name, (event) => {
      event.preventDefault();
      root.classList.add("dropping");
    });
  }
  root.addEventListener("dragleave", (event) => {
    if (!root.contains(event.relatedTarget)) root.classList.remove("dropping");
  });
  root.addEventListener("drop", () => root.classList.remove("dropping"));
}
