/** Where the page comes from: a folder of files on any web server, which the browser keeps for when it is offline. */

import { tables } from "../../made/languages.js";
import { language } from "../words/language_choice.js";

export { loadParts } from "./parts.js";

export const sentences = tables[language] ?? {};
export const hasServer = false;

const program = document.currentScript.src;

/** Return a worker that runs the script of this page, which there begins with engine/worker.js. */
export const startWorker = () => new Worker(program);

// What is written in the page then stays, and says so.
if (location.protocol === "file:") throw new Error("The explorer as a folder opens from a web server only.");

// Browsers have no service workers where a server is neither encrypted nor on this machine: the page does without.
addEventListener("load", () => navigator.serviceWorker?.register("offline.js").catch(() => null));
