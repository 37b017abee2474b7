/** All questions that the page asks of its own engine, by name; a worker answers them. */

import { loadEngine } from "../engine/engine.js";
import { learn } from "../model/known.js";
import { useEngine } from "../model/one_ball.js";
import { calibrateLaw, convertLaw, stackBalls } from "./catalogue.js";
import { exportText } from "./exports.js";
import { AngleJob } from "./angles.js";
import { LineJob } from "./lines.js";
import { MapJob, listPaths } from "./maps.js";
import { playDrop } from "./play.js";

/** Return the functions that answer; `engine`, `layout` and `model` are the contents of the files of these names. */
export async function openDesk({ engine, layout, model }) {
  learn(model);
  useEngine(await loadEngine(engine, layout));
  return {
    simulate: playDrop,
    stack: stackBalls,
    law: calibrateLaw,
    like: convertLaw,
    mapPaths: listPaths,
    exportText,
    mapJob: (request) => new MapJob(request),
    lineJob: (request) => (request.show === "angle" ? new AngleJob(request) : new LineJob(request)),
  };
}
