// What the page says in a language: `node ask_language.mjs PAGE QUESTIONS ANSWERS LANGUAGE`.
//
// QUESTIONS is a list of [module, function, ...arguments] in JSON; ANSWERS has what each returns.

import { readFileSync, writeFileSync } from "node:fs";

const [page, questions, answers, language] = process.argv.slice(2);
globalThis.document = { documentElement: { dataset: {} }, currentScript: {} }; // where there is none the page speaks English
globalThis.navigator ??= {};
globalThis.location = { hash: `#view=play&lang=${language}` };
const found = [];
for (const [module, name, ...given] of JSON.parse(readFileSync(questions, "utf8"))) {
  const { [name]: asked } = await import(`${page}/js/${module}.js`);
  found.push(asked(...given));
}
writeFileSync(answers, JSON.stringify(found));
