/**
 * Where the page comes from: a web server, be it stackbounce's own, which also measures and fits, or any other, which has
 * the page as a folder. In the one file, one_file.js takes the place of this module.
 */

import { tables } from "../../made/languages.js";
import { language } from "../words/language_choice.js";

/** The sentences of the page's language by the English ones; none in English itself. */
export const sentences = tables[language] ?? {};

export const hasServer = globalThis.document?.documentElement.dataset.form !== "folder";

const program = globalThis.document?.currentScript.src;

/** Return a worker that runs the script of this page, which there begins with engine/worker.js. */
export const startWorker = () => new Worker(program);

/** Return what the page computes with: `{engine, layout, model}`. */
export async function loadParts() {
  const [engine, layout, model] = await Promise.all([
    load("engine.wasm", (answer) => answer.arrayBuffer()),
    load("layout.json", (answer) => answer.json()),
    load("model.json", (answer) => answer.json()),
  ]);
  return { engine, layout, model };
}

async function load(name, read) {
  const answer = await fetch(name);
  if (!answer.ok) throw new Error(`${name} could not be loaded.`);
  return read(answer);
}

if (!hasServer) {
  // What is written in the page then stays, and says so.
  if (location.protocol === "file:") throw new Error("The explorer as a folder opens from a web server only.");
  // Browsers have no service workers where a server is neither encrypted nor on this machine: the page does without.
  addEventListener("load", () => navigator.serviceWorker?.register("offline.js").catch(() => null));
}
