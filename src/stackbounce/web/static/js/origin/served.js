/** Where the page comes from: a server, which also measures and fits. In the one file, one_file.js takes its place. */

export const hasServer = true;

/** Load the view that measures and fits. */
export const loadMeasure = () => import("../measure.js");

/** Return a worker that runs engine/worker.js. */
export function startWorker() {
  return new Worker(new URL("../engine/worker.js", import.meta.url), { type: "module" });
}

/** Return what the page computes with: `{engine, layout, model}`. */
export async function loadParts() {
  const [engine, layout, model] = await Promise.all([
    load("made/engine.wasm", (answer) => answer.arrayBuffer()),
    load("made/layout.json", (answer) => answer.json()),
    load("made/model.json", (answer) => answer.json()),
  ]);
  return { engine, layout, model };
}

async function load(name, read) {
  const answer = await fetch(name);
  if (answer.ok) return read(answer);
  const { detail } = await answer.json().catch(() => ({}));
  throw new Error(detail ?? `${name} could not be loaded.`);
}
