/** Where the page comes from: a server of stackbounce, which also measures and fits. In other forms of the page, folder.js
 * or one_file.js takes its place. */

export { loadParts } from "./parts.js";

export const hasServer = true;

/** Load the view that measures and fits. */
export const loadMeasure = () => import("../measure.js");

/** Return a worker that runs engine/worker.js. */
export function startWorker() {
  return new Worker(new URL("../engine/worker.js", import.meta.url), { type: "module" });
}
