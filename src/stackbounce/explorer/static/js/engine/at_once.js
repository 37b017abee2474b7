/** The engine in the page itself: a drop that takes a millisecond or two would take longer to go to a worker and back. */

import { openDesk } from "../answers/desk.js";

const EVENTS = 200; // of a run, and steps between two events: a run that needs more is for the worker
const LONG = 25; // ms
const SHARE = 20; // after runs that were too long, one part in so many of the time is for the next attempts
const FIRST = 8; // runs at the start: a browser makes a program fast when it has run a few times
const APART = 30; // ms between them
const SOME = 300; // frames in each

export class AtOnce {
  desk = null; // what answers, once it is loaded
  rest = -Infinity; // ms, until when drops are left to the worker
  wasLong = false; // the attempt before

  /** Load the engine, and run a drop some times. */
  async open(parts, drop) {
    const desk = await openDesk(parts);
    for (let k = 0; k < FIRST; k += 1) {
      await new Promise((done) => setTimeout(done, APART));
      attempt(desk, drop, null, SOME);
    }
    this.desk = desk;
  }

  /** Return the result of a drop; null where it takes too long, or cannot be run: the worker then says why. */
  play(drop, until, frames) {
    const begun = performance.now();
    if (!this.desk || begun < this.rest) return null;
    const result = attempt(this.desk, drop, until, frames);
    const now = performance.now();
    const isLong = now - begun > LONG;
    if (!result || (isLong && this.wasLong)) this.rest = now + SHARE * (now - begun); // one alone may be the browser's doing
    this.wasLong = isLong;
    return result;
  }
}

function attempt(desk, drop, until, frames) {
  try {
    const result = desk.simulate(drop, until, frames, EVENTS);
    const isWhole = [result, result.separate].every((run) => run?.status !== "EVENT_LIMIT");
    return isWhole ? result : null;
  } catch {
    return null;
  }
}
