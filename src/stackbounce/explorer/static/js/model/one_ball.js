/** One collision of one ball with the floor, by the engine: where a law has no formula for it. */

import { ArithmeticError } from "./python.js";

const TOLERANCE = 1e-12;
const EVENTS = 1000; // events or steps: a collision that can be followed takes some hundred

/** The codes of the forms of forces, by name. */
export const FORMS = {};

let engine = null;

/** Take the engine that runs the drops of this page. */
export function useEngine(one) {
  engine = one;
  Object.assign(FORMS, one.forms);
}

/** Return the engine that was taken. */
export function theEngine() {
  return engine;
}

/** Return the restitution and the contact time in s of a ball on a floor, without gravity. */
export function bounce([form, first, second, third, fourth], mass, speed) {
  const { log, statuses, events, layout } = engine;
  const drop = {
    mass: [mass],
    form: [form],
    first: [first],
    second: [second],
    third: [third],
    fourth: [fourth],
    gap: [0],
    velocity: [-speed],
    gravity: 0,
    rigid: false,
  };
  const run = engine.simulate(drop, { rtol: TOLERANCE, eventLimit: EVENTS, peaks: false });
  if (run.status !== statuses.FINISHED) throw new ArithmeticError();
  let end = 0;
  for (let at = 0; at < run.log.length; at += layout.sizes.log_columns) {
    if (run.log[at + log.KIND] === events.RELEASE) end = Math.max(end, run.log[at + log.TIME]);
  }
  return [run.velocity[0] / speed, end];
}
