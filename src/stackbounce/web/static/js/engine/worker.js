/** The worker: holds the engine, answers questions, and computes maps in slices, between which it listens. */

import { openDesk } from "../answers/desk.js";
import { Wrong } from "../model/errors.js";

const SLICE = 8; // ms of computing between two looks at what has come in

let desk = null;
let newest = 0; // map that was asked for

/** Send an answer, or the words of an error. */
async function answered(id, compute) {
  try {
    postMessage({ id, answer: await compute() });
  } catch (error) {
    const detail = error instanceof Wrong ? error.message : `unexpected ${error.name} (${error.message}): please report it`;
    postMessage({ id, error: detail });
  }
}

/** Compute maps of one drop, from coarse to fine; each is sent when it is whole, unless a newer one was asked for. */
async function drawMaps(id, requests) {
  newest = id;
  let answer = null;
  for (const request of requests) {
    const job = desk.mapJob(request);
    let many = 32;
    while (job.done < job.count) {
      const begin = performance.now();
      job.run(many);
      const passed = performance.now() - begin;
      many = Math.max(1, Math.min(Math.round((many * SLICE) / Math.max(passed, 0.1)), 4 * many));
      await listened();
      if (newest !== id) return null;
    }
    answer = job.answer();
    if (request !== requests.at(-1)) postMessage({ id, part: answer });
  }
  return answer;
}

/** Let messages that have come in be read. */
function listened() {
  const { port1, port2 } = new MessageChannel();
  return new Promise((done) => {
    port1.onmessage = () => {
      port1.close();
      done();
    };
    port2.postMessage(null);
  });
}

self.onmessage = ({ data: { id, name, given } }) => {
  answered(id, async () => {
    if (name === "open") desk = await openDesk(...given);
    else if (name === "maps") return drawMaps(id, ...given);
    else return desk[name](...given);
    return null;
  });
};
