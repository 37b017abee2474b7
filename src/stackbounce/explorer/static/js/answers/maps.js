/** A number of the outcome over two numbers of the drop, in slices. */

import { InvalidValue } from "../model/errors.js";
import { known } from "../model/known.js";
import { nameBall } from "../model/names.js";
import { numbersOf as pathsOf, valueIn } from "../model/paths.js";
import { readDrop } from "../model/schema.js";
import { Points, checkPath, spread } from "./points.js";

const UNMAPPED = ["diameter", "young_modulus", "poisson_ratio"];

/** Return the numbers of a drop that a map can vary, and the outcomes that it can show. */
export function listPaths(mapping) {
  const drop = readDrop(mapping);
  const paths = listNumbers(drop);
  const shows = ["energy_retained"];
  for (const name of Object.keys(known.outcomes)) shows.push(...drop.balls.map((_, i) => `${name}.${i}`));
  const there = shows.filter((show) => show !== "collisions.0" || drop.contacts[0] !== null);
  return { paths, shows: there.map((show) => ({ show, label: nameOutcome(drop, show)[0] })) };
}

/** Return the numbers of a drop that can vary, `{path, label, unit, value}`. */
export function listNumbers(drop) {
  const numbers = pathsOf(drop);
  const found = [];
  for (const [name, { sets, refers, label }] of Object.entries(known.ratios)) {
    const [one, other] = [numbers.get(sets), numbers.get(refers)];
    if (!one || !other || one.unit !== other.unit) continue;
    found.push({ path: name, label, unit: "", value: valueIn(drop, one) / valueIn(drop, other) });
  }
  for (const number of numbers.values()) {
    const value = valueIn(drop, number);
    if (value === undefined || value === null || UNMAPPED.includes(number.field)) continue;
    found.push({ path: number.path, label: nameNumber(drop, number), unit: number.unit, value });
  }
  return found;
}

function nameNumber(drop, { part, index, field }) {
  const what = field.replaceAll("_", " ");
  if (part === "balls") return `${what} of ${nameBall(drop, index)}`;
  if (part === "contacts") return `${what} of ${nameContact(drop, index)}`;
  if (part === "gaps") return `gap above ${nameBall(drop, index)}`;
  if (part === "velocities") return `velocity of ${nameBall(drop, index)}`;
  return what;
}

function nameContact(drop, index) {
  return `${index === 0 ? "floor" : nameBall(drop, index - 1)} and ${nameBall(drop, index)}`;
}

/** Return label and unit of an outcome. */
export function nameOutcome(drop, show) {
  if (show === "energy_retained") return known.energy;
  const [name, index] = split(show);
  const all = Object.keys(known.outcomes).flatMap((kind) => drop.balls.map((_, i) => `${kind}.${i}`));
  if (!all.includes(show)) throw new InvalidValue(`${show} is no outcome`);
  const [words, unit] = known.outcomes[name];
  return [words.replace("{ball}", nameBall(drop, index)).replace("{contact}", nameContact(drop, index)), unit];
}

function split(show) {
  const [name, index] = show.split(".");
  return [name, Number(index)];
}

/** A map, computed a slice at a time: `run()` until `finished`, then `answer()`. */
export class MapJob {
  constructor({ drop: mapping, x, y, show }) {
    const drop = readDrop(mapping);
    const points = x.count * y.count;
    const most = known.limits.map_points;
    if (points > most) throw new InvalidValue(`x.count times y.count must be at most ${most}, got ${points}`);
    if (x.path === y.path) throw new InvalidValue(`x and y must be two numbers, got ${x.path} twice`);
    this.paths = listNumbers(drop);
    for (const { path } of [x, y]) checkPath(path, this.paths);
    Object.assign(this, { drop, show, count: points, done: 0, unfinished: 0 });
    [this.label, this.unit] = nameOutcome(drop, show);
    this.sides = { x: { path: x.path, values: spread(x) }, y: { path: y.path, values: spread(y) } };
    this.points = new Points(drop, this.sides);
    this.values = Array.from({ length: y.count }, () => new Array(x.count).fill(null));
  }

  get finished() {
    return this.done === this.count;
  }

  /** Compute so many more points, in the order of rows. */
  run(many) {
    const count = Math.min(many, this.count - this.done);
    const outcomes = this.points.solve(this.done, count);
    const across = this.sides.x.values.length;
    const [name, index] = split(this.show);
    for (let k = 0; k < count; k += 1) {
      const point = this.done + k;
      this.values[Math.floor(point / across)][point % across] = outcomes.value(k, name, index);
      if (!outcomes.finished(k)) this.unfinished += 1;
    }
    this.done += count;
  }

  answer() {
    const side = (name) => {
      const { path, values } = this.sides[name];
      const { label, unit } = this.paths.find((number) => number.path === path);
      return { path, label, unit, values };
    };
    const { show, label, unit, values, unfinished } = this;
    return { drop: this.drop.toMapping(), x: side("x"), y: side("y"), show, label, unit, values, unfinished };
  }
}
