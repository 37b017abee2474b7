/** All questions that the page asks of its own engine, by name; a worker answers them, or node in a test. */

import { loadEngine } from "../engine/engine.js";
import { learn } from "../model/known.js";
import { useEngine } from "../model/one_ball.js";
import { readDrop } from "../model/schema.js";
import { calibrateLaw, convertLaw, stackBalls } from "./catalogue.js";
import { exportText } from "./exports.js";
import { MapJob, listPaths } from "./maps.js";
import { playDrop } from "./play.js";

/** Return the functions that answer; `engine`, `layout` and `model` are the contents of the files in made/. */
export async function openDesk({ engine, layout, model }) {
  learn(model);
  useEngine(await loadEngine(engine, layout));
  return {
    read: (drop) => readDrop(drop).toMapping(),
    simulate: playDrop,
    stack: stackBalls,
    law: calibrateLaw,
    like: convertLaw,
    mapPaths: listPaths,
    mapJob: (request) => new MapJob(request),
    exportText,
    map(request) {
      const job = new MapJob(request);
      while (job.done < job.count) job.run(job.count);
      return job.answer();
    },
  };
}
