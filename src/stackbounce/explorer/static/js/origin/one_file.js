/** Where the page comes from: the one file, which holds all that it needs, and no server. */

import { tables } from "../../made/languages.js";
import { language } from "../words/language_choice.js";


export const sentences = tables[language] ?? {};
export const hasServer = false;

const content = (id) => document.getElementById(id).textContent;

let program = null;

/** Return a worker that runs the script of this page, which there begins with engine/worker.js. */
export function startWorker() {
  program ??= URL.createObjectURL(new Blob([content("program")], { type: "text/javascript" }));
  return new Worker(program);
}

/** Return what the page computes with: `{engine, layout, model}`. */
export async function loadParts() {
  const engine = Uint8Array.from(atob(content("engine")), (letter) => letter.charCodeAt(0)).buffer;
  return { engine, layout: JSON.parse(content("layout")), model: JSON.parse(content("model")) };
}
