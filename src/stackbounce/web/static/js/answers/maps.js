/** A number of the outcome over two numbers of the drop: as stackbounce/web/answers/maps.py, in slices. */

import { InvalidValue, Wrong, general, nearest, shown } from "../model/errors.js";
import { known } from "../model/known.js";
import { theEngine } from "../model/one_ball.js";
import { dropAt, numbersOf as pathsOf, valueIn } from "../model/paths.js";
import { readDrop } from "../model/schema.js";
import { numbersOf } from "../run/result.js";
import { spaced } from "./play.js";

const UNMAPPED = ["diameter", "young_modulus", "poisson_ratio"];
const PER_BALL = ["mass", "kind", "stiffness", "exponent", "law_parameter", "second_parameter", "gap", "velocity"];

/** Return the numbers of a drop that a map can vary, and the outcomes that it can show. */
export function listPaths(mapping) {
  const drop = readDrop(mapping);
  const paths = listNumbers(drop);
  const shows = ["energy_retained"];
  for (const name of Object.keys(known.outcomes)) shows.push(...drop.balls.map((_, i) => `${name}.${i}`));
  const there = shows.filter((show) => show !== "collisions.0" || drop.contacts[0] !== null);
  return { paths, shows: there.map((show) => ({ show, label: nameOutcome(drop, show)[0] })) };
}

function listNumbers(drop) {
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

function nameBall(drop, index) {
  return drop.balls[index].name || `ball ${index}`;
}

function nameContact(drop, index) {
  return `${index === 0 ? "floor" : nameBall(drop, index - 1)} and ${nameBall(drop, index)}`;
}

/** Return label and unit of what a map shows. */
function nameOutcome(drop, show) {
  if (show === "energy_retained") return known.energy;
  const [name, index] = split(show);
  const all = Object.keys(known.outcomes).flatMap((one) => drop.balls.map((_, i) => `${one}.${i}`));
  if (!all.includes(show)) throw new InvalidValue(`${shown(show)} is no outcome; ${nearest(show, ["energy_retained", ...all])}`);
  const [words, unit] = known.outcomes[name];
  return [words.replace("{ball}", nameBall(drop, index)).replace("{contact}", nameContact(drop, index)), unit];
}

function split(show) {
  const [name, index] = show.split(".");
  return [name, Number(index)];
}

/** Return the values along a side, evenly spaced or in equal ratios. */
function spread({ low, high, count, log }) {
  for (const [name, value] of [["low", low], ["high", high]]) {
    if (log && value <= 0) throw new InvalidValue(`${name} must be above 0 on a logarithmic scale, got ${general(value)}`);
  }
  if (low === high) throw new InvalidValue(`high must differ from low, got ${general(high)} twice`);
  const exponents = log && spaced(Math.log10(low), Math.log10(high), count);
  const values = log ? exponents.map((power, i) => ends(i, count, low, high) ?? 10 ** power) : spaced(low, high, count);
  if (values.every(Number.isFinite)) return values;
  throw new InvalidValue(`low and high must be nearer to each other, got ${general(low)} and ${general(high)}`);
}

function ends(i, count, low, high) {
  if (i === 0) return low;
  return i === count - 1 ? high : undefined;
}

/** A map, computed a slice at a time: `run()` until `done`, then `answer()`. */
export class MapJob {
  constructor({ drop: mapping, x, y, show }) {
    const drop = readDrop(mapping);
    const points = x.count * y.count;
    const most = known.limits.map_points;
    if (points > most) throw new InvalidValue(`x.count times y.count must be at most ${most}, got ${points}`);
    if (x.path === y.path) throw new InvalidValue(`x and y must be two numbers, got ${x.path} twice`);
    this.paths = listNumbers(drop);
    const names = this.paths.map(({ path }) => path);
    for (const { path } of [x, y]) {
      if (!names.includes(path)) throw new InvalidValue(`${shown(path)} is not a parameter of this drop; ${nearest(path, names)}`);
    }
    Object.assign(this, { drop, show, sides: { x, y }, done: 0 });
    [this.label, this.unit] = nameOutcome(drop, show);
    this.axes = { x: spread(x), y: spread(y) };
    this.across = x.count;
    this.count = points;
    this.varied = this.vary();
    this.check();
    this.base = numbersOf(drop);
    this.springs = this.suitsTwoSprings();
    this.values = Array.from({ length: y.count }, () => new Array(x.count).fill(null));
    this.unfinished = 0;
  }

  /** Return `[{number, dims, at(i, j)}]`: the numbers that vary; a ratio sets the first of its two numbers. */
  vary() {
    const { drop } = this;
    const numbers = pathsOf(drop);
    const arrays = new Map();
    for (const name of ["x", "y"]) {
      const values = this.axes[name];
      arrays.set(this.sides[name].path, { dims: [name], at: (i, j) => values[name === "x" ? i : j] });
    }
    for (const [name, { sets, refers }] of Object.entries(known.ratios)) {
      if (!arrays.has(name)) continue;
      if (arrays.has(sets)) throw new InvalidValue(`x and y must be independent, got ${name} and ${sets}`);
      const ratio = arrays.get(name);
      arrays.delete(name);
      const own = valueIn(drop, numbers.get(refers));
      const other = arrays.get(refers) ?? { dims: [], at: () => own };
      const dims = [...new Set([...ratio.dims, ...other.dims])];
      arrays.set(sets, { dims, at: (i, j) => ratio.at(i, j) * other.at(i, j) });
    }
    const varied = [...arrays].map(([path, one]) => ({ number: numbers.get(path), ...one }));
    this.checkTogether(varied.map(({ number }) => number));
    return varied;
  }

  /** Two numbers of a law that determine each other cannot both vary. */
  checkTogether(numbers) {
    for (const one of numbers) {
      const law = one.part === "contacts" ? this.drop.contacts[one.index] : null;
      const twin = law?.constructor.loss_fields().find((field) => field !== one.field);
      const other = numbers.find(({ part, index, field }) => part === one.part && index === one.index && field === twin);
      if (law?.constructor.loss_fields()[0] !== one.field || !other) continue;
      throw new InvalidValue(`${one.path} and ${other.path}: only one of the two can vary`);
    }
  }

  /** Raise for the first point whose drop is none; where all corners are drops, all points are. */
  check() {
    const { drop, varied } = this;
    const [columns, rows] = [this.axes.x.length, this.axes.y.length];
    const at = (i, j) => dropAt(drop, varied.map((one) => [one.number, one.at(i, j)]));
    try {
      for (const i of [0, columns - 1]) for (const j of [0, rows - 1]) at(i, j);
      if (!drop.velocities) return;
    } catch (error) {
      if (!(error instanceof Wrong)) throw error;
    }
    const dims = [...new Set(varied.flatMap((one) => one.dims))];
    const sizes = { x: columns, y: rows };
    for (let a = 0; a < sizes[dims[0]]; a += 1) {
      for (let b = 0; b < sizes[dims[1]]; b += 1) {
        const place = { [dims[0]]: a, [dims[1]]: b };
        try {
          at(place.x, place.y);
        } catch (error) {
          if (!(error instanceof Wrong)) throw error;
          const there = varied.map((one) => `${one.number.path} = ${general(one.at(place.x, place.y), 10)}`).join(", ");
          throw new InvalidValue(`${error.message} (at ${dims.map((dim) => `${dim} ${place[dim]}`).join(", ")}: ${there})`);
        }
      }
    }
  }

  /** Whether the engine for two balls on springs can run all drops. */
  suitsTwoSprings() {
    const { base, drop } = this;
    const { POWER } = theEngine().forms;
    const linear = base.kind.every((kind, i) => kind === POWER && base.exponent[i] === 1);
    const together = new Set(base.velocity).size === 1 && base.velocity[0] < 0;
    const free = this.varied.some(({ number }) => number.part === "velocities" || ["exponent", "gravity"].includes(number.field));
    return drop.balls.length === 2 && drop.gravity === 0 && linear && together && !free;
  }

  /** Compute so many more points, in the order of rows. */
  run(many) {
    const count = Math.min(many, this.count - this.done);
    const drops = this.rows(this.done, count);
    const options = { rtol: known.map_rtol, eventLimit: known.limits.events, springs: this.springs };
    const outcomes = theEngine().sweep(drops, options);
    for (let k = 0; k < count; k += 1) {
      const point = this.done + k;
      const value = outcomes.status[k] <= theEngine().statuses.COLLAPSED ? this.select(outcomes, k, drops) : NaN;
      if (Number.isFinite(value)) this.values[Math.floor(point / this.across)][point % this.across] = value;
      if (outcomes.status[k] > theEngine().statuses.COLLAPSED) this.unfinished += 1;
    }
    this.done += count;
  }

  /** Return the numbers of some drops as the engine takes them. */
  rows(from, count) {
    const { base } = this;
    const drops = { rigid: base.rigid, gravity: repeated([base.gravity], count) };
    for (const name of PER_BALL) drops[name] = repeated(base[name], count);
    this.writers ??= this.makeWriters();
    for (const { dims, targets, numbers } of this.writers) {
      const [across, up] = ["x", "y"].map((dim) => dims.includes(dim));
      const places = targets.map(([name, place]) => [drops[name], place, drops[name].length / count]);
      for (let k = 0; k < count; k += 1) {
        const [i, j] = [(from + k) % this.across, Math.floor((from + k) / this.across)];
        const values = numbers(across ? i : 0, up ? j : 0);
        for (let t = 0; t < places.length; t += 1) places[t][0][k * places[t][2] + places[t][1]] = values[t];
      }
    }
    return drops;
  }

  /** Return `[{dims, targets, numbers(i, j)}]`: what the engine's numbers become that a varied number changes. */
  makeWriters() {
    const { base, drop, varied } = this;
    const writers = [];
    const write = (some, targets, numbers) => {
      const dims = [...new Set(some.flatMap((one) => one.dims))];
      writers.push({ dims, targets, numbers: dims.length === 1 ? remembered(numbers) : numbers });
    };
    for (const one of varied) {
      const { part, index } = one.number;
      if (part === "gaps") write([one], [["gap", index + 1]], (i, j) => [one.at(i, j)]);
      if (part === "velocities") write([one], [["velocity", index]], (i, j) => [one.at(i, j)]);
      if (part === "balls") write([one], [["mass", index]], (i, j) => [one.at(i, j)]);
    }
    drop.contacts.forEach((law, contact) => {
      const own = varied.filter(({ number }) => number.part === "contacts" && number.index === contact);
      const constants = (i, j) => Object.fromEntries(own.map((one) => [one.number.field, one.at(i, j)]));
      const targets = ["stiffness", "exponent", "law_parameter", "second_parameter"].map((name) => [name, contact]);
      if (own.length) write(own, targets, (i, j) => law.engine_numbers(constants(i, j)).slice(1));
    });
    const fall = varied.filter(({ number }) => ["gravity", "height", "impact_speed"].includes(number.field));
    const given = (field) => fall.find(({ number }) => number.field === field);
    const speeds = (i, j) => {
      const gravity = given("gravity")?.at(i, j) ?? base.gravity;
      const height = given("height")?.at(i, j) ?? drop.height;
      const speed = given("impact_speed")?.at(i, j) ?? Math.sqrt(2 * (gravity || known.gravity) * height);
      return [gravity, ...drop.balls.map(() => -speed)];
    };
    const falls = given("height") || given("impact_speed") || drop.height !== undefined;
    const targets = [["gravity", 0], ...drop.balls.map((_, ball) => ["velocity", ball])];
    if (fall.length) write(fall, falls ? targets : targets.slice(0, 1), speeds);
    return writers;
  }

  select(outcomes, row, drops) {
    if (this.show === "energy_retained") return outcomes.energy_retained[row];
    const [name, index] = split(this.show);
    const balls = this.drop.balls.length;
    const place = row * balls + index;
    if (name === "collisions") return outcomes.collisions[place];
    const ratio = outcomes.rebound_ratio[place];
    if (name === "rebound_ratio") return ratio;
    const reference = drops.velocity.subarray(row * balls, (row + 1) * balls).reduce((most, one) => Math.max(most, Math.abs(one)), 0);
    const speed = ratio * reference;
    return (speed * Math.abs(speed)) / (2 * known.gravity);
  }

  answer() {
    const side = (name) => {
      const { path, label, unit } = this.paths.find((one) => one.path === this.sides[name].path);
      return { path, label, unit, values: this.axes[name] };
    };
    const { show, label, unit, values, unfinished } = this;
    return { drop: this.drop.toMapping(), x: side("x"), y: side("y"), show, label, unit, values, unfinished };
  }
}

/** Return an array of some numbers, so many times. */
function repeated(numbers, count) {
  const all = new Float64Array(count * numbers.length);
  all.set(numbers);
  for (let done = numbers.length; done < all.length; done *= 2) all.copyWithin(done, 0, done);
  return all;
}

/** Return a function of the places along one side that computes each once. */
function remembered(numbers) {
  const found = [];
  return (i, j) => (found[i + j] ??= numbers(i, j)); // one of the two is 0
}
