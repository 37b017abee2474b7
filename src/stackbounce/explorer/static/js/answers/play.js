/** The motion of a drop at each moment, and the textbook's beside it. */

import { separate } from "../model/calibration.js";
import { InvalidValue } from "../model/errors.js";
import { known } from "../model/known.js";
import { readDrop } from "../model/schema.js";
import { simulate } from "../run/result.js";
import { leaveSideways } from "../run/sideways.js";

const INTERVALS = 60; // most contact intervals that get frames of their own
const BEFORE = 0.15; // margins, over the duration of the impact
const AFTER = 0.35;
const INSTANT = 0.01; // s: used as the duration of an instantaneous impact

/** Return a drop's result, within the limits of the page or with fewer events. */
export function runDrop(drop, until, eventLimit = known.limits.events) {
  return simulate(drop, { until: until ?? Infinity, rtol: known.rtol, eventLimit });
}

/** Return the end of a run in s, checked; null for the impact alone. */
export function checkUntil(until) {
  if (until === null || until === undefined) return null;
  if (typeof until === "number" && until > 0 && until <= known.limits.duration) return until;
  const right = `a positive number of seconds, at most ${known.limits.duration}`;
  throw new InvalidValue(`until must be ${right}, got ${until}`);
}

/** Drop a stack of balls: numbers, intervals, frames, and the separate collisions of the same drop. */
export function playDrop(mapping, until_, frames, eventLimit) {
  const drop = readDrop(mapping);
  const until = checkUntil(until_);
  const result = runDrop(drop, until, eventLimit);
  const times = chooseTimes(result, until, frames);
  const ends = result.intervals.map(({ end }) => end).filter(Number.isFinite);
  return {
    drop: drop.toMapping(),
    reference_speed: drop.speed,
    ...numbers(result, drop.pull),
    intervals: result.intervals.map((interval) => plain(interval)),
    impact: [0, Math.max(0, ...ends)],
    frames: { time: times, ...sampleWithEnergy(result, times) },
    ...(until === null && drop.balls.some(({ offset }) => offset) ? { sideways: playSideways(result) } : {}),
    separate: drop.rigid ? null : playSeparate(drop, until, times, eventLimit),
  };
}

/** Return how balls off the middle leave, or why that is not known. */
function playSideways(result) {
  try {
    return leaveSideways(result, [result.drop.balls.map(({ offset }) => offset ?? 0)])[0];
  } catch (error) {
    if (error instanceof InvalidValue) return { error: error.message };
    throw error;
  }
}

/** Return numbers with null for those that are not finite. */
function plain(values) {
  const finite = (value) => (typeof value === "number" && !Number.isFinite(value) ? null : value);
  if (Array.isArray(values)) return values.map(finite);
  return Object.fromEntries(Object.entries(values).map(([name, value]) => [name, finite(value)]));
}

function numbers(result, pull) {
  const { speeds, drop } = result;
  return {
    status: result.status,
    rebound_speeds: plain(speeds),
    rebound_ratios: plain(speeds.map((speed) => speed / drop.speed)),
    rebound_heights: plain(speeds.map((speed) => (speed * Math.abs(speed)) / (2 * pull))),
    collisions: result.collisions,
    first_touch: plain(result.perContact("start", Math.min)),
    last_release: plain(result.perContact("end", Math.max)),
    energy_retained: plain([result.energyRetained])[0],
    end_time: result.end,
  };
}

/** Return the start and the end in s of what is shown of an impact; the first touch is at 0. */
export function chooseWindow(result) {
  const ends = result.intervals.map(({ end }) => end).filter(Number.isFinite);
  const last = Math.max(0, ...ends, result.end);
  const span = last > 0 ? last : INSTANT;
  return [-BEFORE * span, result.stopped ? last : last + AFTER * span];
}

/** Return ascending times in s: evenly spaced, and the starts and ends of contacts. */
function chooseTimes(result, until, frames) {
  const { drop, intervals } = result;
  let [begin, end] = chooseWindow(result);
  let even = frames;
  if (until !== null) {
    end = result.stopped ? Math.min(until, result.end) : until;
    if (drop.gravity > 0 && drop.velocities === undefined) begin = -drop.speed / drop.gravity; // from rest
    even = Math.floor(frames / 2); // the other half samples the contacts, which are short
  }
  const spans = intervals.slice(0, INTERVALS);
  const each = until === null ? 2 : Math.max(8, Math.floor(even / Math.max(1, spans.length)));
  const all = [...spaced(begin, end, even), 0];
  for (const { start, end: last } of spans) all.push(...spaced(start, Math.min(last, end), each));
  return [...new Set(Float64Array.from(all).sort())].filter((time) => time >= begin && time <= end);
}

/** Return numbers from one end to another, evenly spaced, both included. */
export function spaced(from, to, count) {
  const step = (to - from) / (count - 1);
  return Array.from({ length: count }, (_, i) => (i === count - 1 ? to : from + i * step));
}

/** Return what `Result.sample` does, also at times before the first touch. */
function sampleWithApproach(result, times) {
  const { drop } = result;
  const found = result.sample(times.map((time) => Math.max(time, 0)));
  times.forEach((time, row) => {
    if (time >= 0) return;
    let below = 0; // how far the ball below has fallen
    drop.start.forEach((velocity, ball) => {
      const fallen = velocity * time - 0.5 * drop.gravity * time * time;
      found.position[ball][row] += fallen;
      found.velocity[ball][row] -= drop.gravity * time;
      found.compression[ball][row] -= fallen - below;
      found.force[ball][row] = 0;
      below = fallen;
    });
  });
  return found;
}

/** Return a sample with the energies in J over time; of the balls' motion a list each. */
export function sampleWithEnergy(result, times) {
  const { balls, gravity } = result.drop;
  const { stored, ...found } = sampleWithApproach(result, times);
  const kinetic = balls.map(({ mass }, i) => found.velocity[i].map((speed) => 0.5 * mass * speed * speed));
  const moving = summed(kinetic);
  const potential = summed(balls.map(({ mass }, i) => found.position[i].map((height) => mass * gravity * height)));
  const held = summed(stored);
  const total = summed([moving, potential, held]);
  return { ...found, energy: { kinetic, stored: held.map((energy) => Math.max(energy, 0)), potential, total } };
}

/** Return the sums of lists, place by place. */
function summed(lists) {
  const sums = [...lists[0]];
  for (const list of lists.slice(1)) for (let i = 0; i < sums.length; i += 1) sums[i] += list[i];
  return sums;
}

/** Return the separate collisions of a drop at the same times, or why there are none. */
function playSeparate(drop, until, times, eventLimit) {
  try {
    const alone = separate(drop);
    const textbook = until === null ? alone : alone.changed({ gravity: drop.gravity }); // a whole drop has flights
    const result = runDrop(textbook, until, eventLimit);
    const reached = result.stopped ? result.end : Infinity;
    const { position } = sampleWithApproach(result, times.map((time) => Math.min(time, reached)));
    return {
      ...numbers(result, drop.pull),
      restitutions: textbook.contacts.map((law) => law && law.restitution),
      position,
    };
  } catch (error) {
    if (error instanceof InvalidValue) return { error: error.message };
    throw error;
  }
}
