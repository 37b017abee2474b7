/** Changes of a drop: pure functions from one drop to the next. */

import { clean } from "../words/words.js";

export const GRAVITY = 9.80665;

/** The least and the largest number that a field takes of each kind, in SI units; a map or a link may go beyond. */
export const BOUNDS = {
  mass: [1e-6, 1e3],
  diameter: [1e-3, 10],
  gaps: [0, 10],
  velocities: [-100, 100],
  impact_speed: [0.01, 100],
  height: [1e-6, 600],
  gravity: [0, 100],
  until: [0.01, 60],
};
const BEYOND = 1e3; // times

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

/** Return whether a mapping that somebody brought is a drop of numbers that the page takes; those of its laws are theirs to judge. */
export function isDrop(drop) {
  const { balls, contacts, gaps = [], velocities = [] } = drop;
  const members = (list) => Array.isArray(list) && list.length > 0 && list.every((member) => typeof member === "object" && member !== null);
  const fits = (name, value) => {
    const [low, high] = BOUNDS[name];
    return value === undefined || (typeof value === "number" && value >= Math.min(low / BEYOND, low * BEYOND) && value <= high * BEYOND);
  };
  const fit = (name, list) => Array.isArray(list) && list.every((value) => fits(name, value));
  if (!members(balls) || !members(contacts) || !contacts.every(({ law }) => typeof law === "string")) return false;
  if (["height", "impact_speed", "velocities"].filter((kind) => drop[kind] !== undefined).length !== 1) return false;
  const fitAlone = ["height", "impact_speed", "gravity"].every((name) => fits(name, drop[name]));
  const fitBalls = balls.every(({ mass, diameter }) => fits("mass", mass ?? NaN) && fits("diameter", diameter));
  return fitAlone && fitBalls && fit("gaps", gaps) && fit("velocities", velocities);
}

/** Return a drop with a lighter ball on top; `first` is its contact if the one below it has no law. */
export function withBall(drop, first) {
  const top = drop.balls.at(-1);
  const ball = { mass: Math.max(clean(Number((top.mass / 2).toPrecision(3))), BOUNDS.mass[0]) };
  if (top.diameter) ball.diameter = clean(Number((top.diameter * 0.8).toPrecision(2)));
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
  if (drop.height) return Math.sqrt(2 * (drop.gravity || GRAVITY) * drop.height);
  return drop.impact_speed ?? Math.max(...drop.velocities.map(Math.abs));
}

/** Return a drop that comes in as fast, told as "height", "impact_speed" or "velocities". */
export function withIncidence(drop, kind) {
  const { height: _height, impact_speed: _speed, velocities: _velocities, ...rest } = drop;
  const speed = speedOf(drop) || 1;
  if (kind === "height") return { ...rest, height: clean(Number((speed ** 2 / 2 / (drop.gravity || GRAVITY)).toPrecision(4))) };
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
  const upper = drop.balls[contact].mass;
  if (contact === 0) return upper;
  const lower = drop.balls[contact - 1].mass;
  return (upper * lower) / (upper + lower);
}
