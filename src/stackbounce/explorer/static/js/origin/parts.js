/** What the page computes with, where it comes from a web server. */

/** Return `{engine, layout, model}`. */
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
