// Ask the page's own code, here in node: node ask_page.mjs PAGE QUESTIONS ANSWERS EVENTS
// QUESTIONS is a list of [name, arguments] in JSON; ANSWERS has {answer} or {error} of each, with nan and inf as texts.
// A run has at most so many EVENTS.

import { readFileSync, writeFileSync } from "node:fs";

const [page, questions, answers, events] = process.argv.slice(2);
const made = (name) => readFileSync(`${page}/made/${name}`);
const { openDesk } = await import(`${page}/js/answers/desk.js`);
const model = JSON.parse(made("model.json"));
model.limits.events = Number(events);
const { readDrop } = await import(`${page}/js/model/schema.js`);
const desk = await openDesk({ engine: made("engine.wasm"), layout: JSON.parse(made("layout.json")), model });
const finished = (job) => {
  while (!job.finished) job.run(Infinity);
  return job.answer();
};
desk.read = (drop) => readDrop(drop).toMapping();
desk.map = (request) => finished(desk.mapJob(request));
desk.line = (request) => finished(desk.lineJob(request));
const written = (_, value) => {
  if (typeof value === "number" && !Number.isFinite(value)) return String(value);
  return ArrayBuffer.isView(value) ? [...value] : value;
};

const found = JSON.parse(readFileSync(questions, "utf8")).map(([name, ...given]) => {
  try {
    return { answer: desk[name](...given) };
  } catch (error) {
    return { error: error.message, kind: error.constructor.name, stack: error.stack };
  }
});
writeFileSync(answers, JSON.stringify(found, written));
