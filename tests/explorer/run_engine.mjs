// Run what test_engine_wasm.py asks for: node run_engine.mjs ENGINE_JS FOLDER NUMBERS ANSWERS
// NUMBERS and ANSWERS are raw float64 numbers; both Python and this script read them in the order of the test.

import { readFileSync, writeFileSync } from "node:fs";

const [script, folder, numbers, answers] = process.argv.slice(2);
const code = readFileSync(script).toString("base64"); // imported so, a file needs no package.json to be a module
const { loadEngine } = await import(`data:text/javascript;base64,${code}`);
const layout = JSON.parse(readFileSync(`${folder}/layout.json`, "utf8"));
const engine = await loadEngine(readFileSync(`${folder}/engine.wasm`), layout);
const given = new Float64Array(new Uint8Array(readFileSync(numbers)).buffer);
const found = [];

let place = 0;
const take = (count) => given.subarray(place, (place += count));
const tell = (values) => found.push(Float64Array.from(values));

while (place < given.length) {
  const [job, count, balls, rigid, rtol, until, eventLimit, sampled] = take(8);
  const times = take(sampled);
  const drops = { rigid: rigid === 1 };
  for (const { name, columns } of layout.records.Drops) drops[name] = take(count * (columns.balls ? balls : 1));
  if (job === 0) {
    const run = engine.simulate({ ...drops, gravity: drops.gravity[0] }, { rtol, until, eventLimit, times });
    const { position, velocity, compression, force, stored } = run.samples;
    tell([run.status, run.time, run.log.length]);
    for (const values of [run.velocity, run.log, run.infinite]) tell(values);
    for (const values of [position, velocity, compression, force, stored]) tell(values);
  } else {
    const outcomes = engine.sweep(drops, { rtol, until, eventLimit, lanes: [null, null, "run_two_springs", "run_pairs", "run_linear"][job] });
    for (const { name } of layout.records.Outcomes) tell(outcomes[name]);
  }
}
writeFileSync(answers, Buffer.concat(found.map(({ buffer }) => Buffer.from(buffer))));
