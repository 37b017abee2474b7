// Answers by how much a track is shifted to lie on a line: node ask_shift.mjs PAGE ASKED ANSWERED.
import { readFileSync, writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [page, asked, answered] = process.argv.slice(2);
const { bestShift } = await import(pathToFileURL(`${page}/js/views/measure/record.js`));
const { track, line, reach, until } = JSON.parse(readFileSync(asked));
writeFileSync(answered, JSON.stringify(bestShift([track], [line], reach, until)));
