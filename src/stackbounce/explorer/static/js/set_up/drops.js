/** Changes of a drop: pure functions from one drop to the next. */

import { clean, numeric } from "../words/words.js";

export const GRAVITY = 9.80665;
const NEW_MASS = 0.05; // kg of a ball on top of one whose mass cannot be read

/** Return a copy of a drop with the value at a path such as "balls.0.mass" changed. */
export function withValue(drop, path, value) {
  const parts = path.split(".");
  const change = (place, depth) => {
    const part = parts[depth];
    const copy = Array.isArray(place) ? [...place] : { ...place };
    copy[part] = depth === parts.length - 1 ? value : change(copy[part] ?? {}, depth + 1);
    return copy;
  };
  return change(drop, 0);
}

/** Return the value of a drop at a path, or undefined. */
export function valueAt(drop, path) {
  return path.split(".").reduce((place, part) => place?.[part], drop);
}

/** Return the gaps of a drop, which may leave them out. */
export function gapsOf(drop) {
  return drop.balls.slice(1).map((_, i) => drop.gaps?.[i] ?? 0);
}

/** Return a drop with all its gaps and its gravity said. */
export function complete(drop) {
  return { ...drop, gaps: gapsOf(drop), gravity: drop.gravity ?? 0 };
}

/** Return whether a mapping that somebody brought has the shape of a drop; its numbers are the server's to judge. */
export function isDrop(drop) {
  const { balls, contacts, gaps, velocities } = drop;
  const members = (list) => Array.isArray(list) && list.every((member) => typeof member === "object" && member !== null);
  const numbers = (list) => list === undefined || (Array.isArray(list) && list.every((member) => typeof member !== "object"));
  if (!members(balls) || !members(contacts) || balls.length === 0 || balls.length !== contacts.length) return false;
  return contacts.every(({ law }) => typeof law === "string") && numbers(gaps) && numbers(velocities);
}

/** Return a drop with a lighter ball on top; `first` is its contact if the one below it has no law. */
export function withBall(drop, first) {
  const top = drop.balls.at(-1);
  const mass = numeric(top.mass, "kg");
  const diameter = numeric(top.diameter, "m");
  const ball = { mass: Number.isFinite(mass) ? clean(Number((mass / 2).toPrecision(3))) : NEW_MASS };
  if (Number.isFinite(diameter)) ball.diameter = clean(Number((diameter * 0.8).toPrecision(2)));
  const last = drop.contacts.at(-1);
  const contact = last.law === "none" ? first : last;
  const next = {
    ...drop,
    balls: [...drop.balls, ball],
    contacts: [...drop.contacts, { ...contact }],
    gaps: [...gapsOf(drop), 0],
  };
  if (drop.velocities) next.velocities = [...drop.velocities, drop.velocities.at(-1)];
  return next;
}

/** Return a drop without one of its balls and the contact below it; the floor's contact stays. */
export function withoutBall(drop, ball) {
  const without = (list, place) => list.filter((_, i) => i !== place);
  const next = {
    ...drop,
    balls: without(drop.balls, ball),
    contacts: without(drop.contacts, Math.max(ball, 1)),
    gaps: without(gapsOf(drop), Math.max(ball - 1, 0)),
  };
  if (drop.velocities) next.velocities = without(drop.velocities, ball);
  return next;
}

/** Return a drop with a ball and the one above it changed round; contacts and gaps keep their places. */
export function withSwap(drop, lower) {
  const swap = (list) => {
    const next = [...list];
    [next[lower], next[lower + 1]] = [next[lower + 1], next[lower]];
    return next;
  };
  const next = { ...drop, balls: swap(drop.balls) };
  if (drop.velocities) next.velocities = swap(drop.velocities);
  return next;
}

/** Return the speed in m/s that a drop comes in with. */
export function speedOf(drop) {
  const speed = numeric(drop.impact_speed, "m/s");
  if (Number.isFinite(speed)) return speed;
  const height = numeric(drop.height, "m");
  const gravity = numeric(drop.gravity ?? 0, "m/s**2") || GRAVITY;
  if (Number.isFinite(height)) return Math.sqrt(2 * gravity * height);
  return Math.max(...(drop.velocities ?? []).map((velocity) => Math.abs(numeric(velocity, "m/s"))));
}

/** Return a drop that comes in as fast, told as "height", "impact_speed" or "velocities". */
export function withIncidence(drop, kind) {
  const { height: _height, impact_speed: _speed, velocities: _velocities, ...rest } = drop;
  const speed = speedOf(drop) || 1;
  const gravity = numeric(drop.gravity ?? 0, "m/s**2") || GRAVITY;
  if (kind === "height") return { ...rest, height: clean(Number((speed ** 2 / 2 / gravity).toPrecision(4))) };
  const rounded = clean(Number(speed.toPrecision(4)));
  if (kind === "velocities") return { ...rest, velocities: drop.balls.map(() => -rounded) };
  return { ...rest, impact_speed: rounded };
}

/** Return which of the three ways a drop tells how it comes in. */
export function incidenceOf(drop) {
  return ["height", "velocities"].find((kind) => drop[kind] !== undefined && drop[kind] !== null) ?? "impact_speed";
}

/** Return the mass in kg that a contact feels: the ball's at the floor, else the reduced one. */
export function contactMass(drop, contact) {
  const upper = numeric(drop.balls[contact].mass, "kg");
  if (contact === 0) return upper;
  const lower = numeric(drop.balls[contact - 1].mass, "kg");
  return (upper * lower) / (upper + lower);
}
