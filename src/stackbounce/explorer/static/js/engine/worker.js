/** The worker: holds the engine, answers questions, and computes maps and lines in slices, between which it listens. */

import { openDesk } from "../answers/desk.js";
import { InvalidValue } from "../model/errors.js";
import { messagesRead } from "../pace.js";

const SLICE = 8; // ms of computing between two looks at what has come in
const OFTEN = 40; // ms between two stages of a line that are shown
const ENOUGH = 3000; // ms after which a line is not made finer

let desk = null;
let newest = 0; // map or line that was asked for

/** Send an answer, or the words of an error. */
async function answered(id, compute) {
  try {
    postMessage({ id, answer: await compute() });
  } catch (error) {
    const detail = error instanceof InvalidValue ? error.message : `unexpected ${error.name} (${error.message}): please report it`;
    postMessage({ id, error: detail });
  }
}

/**
 * Compute maps or lines of one drop, from coarse to fine, and return the last one; the others are sent when they are
 * whole, unless a newer question came.
 */
async function draw(id, start, requests) {
  newest = id;
  let answer = null;
  for (const request of requests) {
    const job = start(request);
    const begin = performance.now();
    let sent = begin;
    let many = 32;
    while (!job.finished) {
      const before = performance.now();
      job.run(many);
      const passed = performance.now() - before;
      many = Math.max(1, Math.min(Math.round((many * SLICE) / Math.max(passed, 0.1)), 4 * many));
      await messagesRead();
      if (newest !== id) return null;
      const now = performance.now();
      if (!job.whole || now - sent < OFTEN) continue; // a map has no stages: it is whole at its end
      if (now - begin > ENOUGH) break;
      sent = now;
      if (!job.finished) postMessage({ id, part: job.answer() });
    }
    answer = job.answer();
    if (request !== requests.at(-1)) postMessage({ id, part: answer });
  }
  return answer;
}

self.onmessage = ({ data: { id, name, given } }) => {
  answered(id, async () => {
    if (name === "open") desk = await openDesk(...given);
    else if (name === "maps") return draw(id, desk.mapJob, ...given);
    else if (name === "lines") return draw(id, desk.lineJob, ...given);
    else return desk[name](...given);
    return null;
  });
};
