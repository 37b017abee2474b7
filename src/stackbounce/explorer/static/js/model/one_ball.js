/** One collision of one ball with the floor, by the engine. */

/** A collision that cannot be followed to its end, or a number out of range. */
export class OutOfRange extends Error {}

const TOLERANCE = 1e-12;
const EVENTS = 100_000; // events or steps: most collisions take less than a hundred, and a very stiff one some 10 000

let engine = null;

/** Take the engine that runs the drops of this page. */
export function useEngine(one) {
  engine = one;
}

/** Return the engine that was taken. */
export function theEngine() {
  return engine;
}

/** Return the restitution and the contact time in s of a ball on a floor with a law, without gravity. */
export function bounce(law, mass, speed) {
  const { log, statuses, events, layout } = engine;
  const [form, first, second, third, fourth] = law.engineNumbers();
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
    rigid: law.rigid,
  };
  const run = engine.simulate(drop, { rtol: TOLERANCE, eventLimit: EVENTS, peaks: false });
  if (run.status !== statuses.FINISHED) throw new OutOfRange();
  let end = 0;
  for (let at = 0; at < run.log.length; at += layout.sizes.log_columns) {
    if (run.log[at + log.KIND] === events.RELEASE) end = Math.max(end, run.log[at + log.TIME]);
  }
  return [Math.min(run.velocity[0] / speed, 1), end]; // no more but for round-off
}
