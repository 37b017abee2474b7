/** Where the page comes from: a server of stackbounce, which also measures and fits. In other forms of the page, folder.js
 * or one_file.js takes its place. */

import { language } from "../words/language_choice.js";

export { loadParts } from "./parts.js";

/** The sentences of the page's language by the English ones: loaded before the page is built, and none in English itself. */
export const sentences = language === "en" ? {} : await loadSentences().catch(() => ({}));

async function loadSentences() {
  return (await fetch(new URL(`../languages/${language}.json`, import.meta.url))).json();
}

export const hasServer = true;

/** Return a worker that runs engine/worker.js. */
export function startWorker() {
  return new Worker(new URL("../engine/worker.js", import.meta.url), { type: "module" });
}
