/**
 * Where the balls are at each moment of a drop: fall, impact and leap.
 *
 * The engine computes the impact. Before the first touch and after its last separation a ball flies freely, which is a
 * closed form with the drop's gravity, or the standard one where the drop has none during its impact. The leap ends where
 * the highest ball is back. Balls do not meet in flight: a drop is finished when none approaches another, and all
 * fall alike. A ball that comes back to where it lay on the stack stays there, as its next bounce is not computed.
 * A drop that the engine did not finish has no leap.
 */

import { between, locate } from "./clock.js";
import { GRAVITY } from "../set_up/drops.js";

const DOWN = 0.12; // s after the highest top, where there is no floor to come back to
const STILL = 0.4; // s of a leap in which no ball rises
const ENDED = ["FINISHED", "COLLAPSED", "SETTLED"]; // what the engine computed to its end

/**
 * Return a drop's motion: `at(time)` is `{position, velocity, compression}` by ball, in SI units from where each ball lies
 * in the stack; `fall`, `last`, `rise` and `leap` in s: how long before the touch at 0, the last separation, how long after it
 * until the highest top, or null without one, and until the end.
 */
export function motionOf(result) {
  const { frames, drop, intervals, status } = result;
  const g = drop.gravity || GRAVITY;
  const floor = (drop.contacts[0]?.law ?? "none") !== "none";
  const ended = ENDED.includes(status);
  const ends = intervals.map(({ end }) => end ?? 0);
  const last = Math.min(ended ? Math.max(0, ...ends) : frames.time.at(-1), frames.time.at(-1));
  const touch = sampled(frames, 0);
  const freed = drop.balls.map((_, ball) =>
    intervals.filter(({ contact }) => contact === ball || contact === ball + 1).reduce((most, { end }) => Math.max(most, end ?? 0), 0),
  );
  const flights = ended ? flightsOf({ ...frames, leaves: leaving(result, drop) }, freed, last, g, floor) : [];
  const falling = (time) => ({
    position: touch.position.map((p, ball) => p + touch.velocity[ball] * time - 0.5 * g * time * time),
    velocity: touch.velocity.map((v) => v - g * time),
    compression: touch.position.map(() => 0),
  });
  const at = (time) => {
    if (time < 0) return falling(time);
    const found = sampled(frames, Math.min(time, last));
    flights.forEach((flight, ball) => {
      if (time <= flight.from) return;
      const flown = flightAt(flight, time, g);
      found.position[ball] = flown.position;
      found.velocity[ball] = flown.velocity;
      if (time > last) found.compression[ball] = 0;
    });
    return found;
  };
  return {
    at,
    last,
    fall: fallTime(touch, g, floor),
    ...leapOf(flights, last),
    tops: flights.map(({ top }) => top),
    lies: (ball, time) => time >= (flights[ball]?.lands ?? Infinity),
  };
}

/** Return a whole drop's motion: all of it is in its frames. */
export function wholeMotion({ frames }) {
  return { at: (time) => sampled(frames, time), last: frames.time.at(-1), tops: [], lies: () => false };
}

/**
 * Return the textbook's positions, `{at(time), tops}`, or null where it has none: its separate collisions, then flights.
 * `at` is null before the touch, when there is no difference yet.
 */
export function ghostMotion(result, whole) {
  const { separate, frames, drop } = result;
  if (!separate?.position) return null;
  const sample = (time) => {
    const place = locate(frames.time, time);
    return separate.position.map((values) => between(values, place));
  };
  if (whole) return { at: sample, tops: [] };
  const g = drop.gravity || GRAVITY;
  const floor = (drop.contacts[0]?.law ?? "none") !== "none";
  const freed = drop.balls.map((_, ball) => Math.max(0, separate.last_release[ball] ?? 0, separate.last_release[ball + 1] ?? 0));
  const last = Math.max(...freed);
  const inside = last <= frames.time.at(-1);
  const positions = { time: frames.time, position: separate.position, leaves: leaving(separate, drop) };
  const flights = inside ? flightsOf(positions, freed, last, g, floor) : [];
  const at = (time) => {
    if (time < 0 || (!inside && time > frames.time.at(-1))) return null;
    const found = sample(Math.min(time, last));
    flights.forEach((flight, ball) => {
      if (time > flight.from) found[ball] = flightAt(flight, time, g).position;
    });
    return found;
  };
  return { at, tops: flights.map(({ top }) => top) };
}

function sampled({ time: times, position, velocity, compression }, time) {
  const place = locate(times, time);
  const all = (lists) => lists.map((values) => between(values, place));
  return { position: all(position), velocity: all(velocity), compression: all(compression) };
}

/**
 * Return each ball's flight, `{from, position, velocity, top, level, lands}`: since its own last separation, or for all
 * since the last one of all, where gravity on one of them alone would bring two balls together.
 */
function flightsOf({ time: times, position, leaves }, freed, last, g, floor) {
  const flight = (ball, from) =>
    withTop({ from, position: between(position[ball], locate(times, from)), velocity: leaves(ball, from) }, last, g, floor);
  const own = position.map((_, ball) => flight(ball, Math.min(freed[ball], last)));
  const where = (ball, time, i) => (time > own[ball].from ? flightAt(own[ball], time, g).position : position[ball][i]);
  const apart = times.every((time, i) => {
    const flies = (ball) => time > own[ball].from && time <= last;
    return position.every((_, ball) => ball === 0 || !(flies(ball) || flies(ball - 1)) || where(ball, time, i) >= where(ball - 1, time, i));
  });
  const speeds = own.map((flight) => flightAt({ ...flight, lands: Infinity }, last, g).velocity);
  const parting = speeds.every((speed, ball) => ball === 0 || speed >= speeds[ball - 1]);
  return apart && parting ? own : position.map((_, ball) => flight(ball, last));
}

/** Return a function of ball and time that gives the velocity with which a ball flies since its last separation. */
function leaving({ status, rebound_speeds: speeds, end_time: end }, { gravity }) {
  return (ball, time) => (status === "SETTLED" ? 0 : speeds[ball] + gravity * (end - time));
}

/** Return a flight with its top, and the time and level at which the ball comes back: to its place, if it was that high. */
function withTop({ from, position, velocity }, last, g, floor) {
  const top = velocity > 0 ? { time: from + velocity / g, height: position + velocity ** 2 / 2 / g } : null;
  const level = velocity ** 2 + 2 * g * position >= 0 ? 0 : position;
  const back = (velocity + Math.sqrt(velocity ** 2 + 2 * g * (position - level))) / g;
  return { from, position, velocity, top, level, lands: floor ? Math.max(last, from + back) : Infinity };
}

function flightAt({ from, position, velocity, level, lands }, time, g) {
  if (time >= lands) return { position: level, velocity: 0 };
  const flown = time - from;
  return { position: position + velocity * flown - 0.5 * g * flown * flown, velocity: velocity - g * flown };
}

/** Return how long the balls fell before the touch: from rest, or since they were together or at the floor. */
function fallTime({ position, velocity }, g, floor) {
  let longest = Math.max(0, ...velocity.map((v) => -v / g));
  velocity.slice(1).forEach((above, i) => {
    const parting = above - velocity[i];
    if (parting > 0) longest = Math.min(longest, Math.max(0, position[i + 1] - position[i]) / parting);
  });
  const [p, v] = [Math.max(position[0], 0), velocity[0]];
  return floor ? Math.max(0, Math.min(longest, (-v + Math.sqrt(v * v + 2 * g * p)) / g)) : longest;
}

/** Return how long after the last separation the highest ball has its top, and is back. */
function leapOf(flights, last) {
  const rising = flights.filter(({ top }) => top && top.time > last);
  const highest = rising.reduce((one, other) => (one && one.top.height > other.top.height ? one : other), null);
  if (!highest) return { rise: null, leap: flights.length ? STILL : 0 };
  const rise = highest.top.time - last;
  return { rise, leap: Number.isFinite(highest.lands) ? highest.lands - last : rise + DOWN };
}
