/** A drop at many values of its numbers: what maps and lines compute. */

import { InvalidValue, general } from "../model/errors.js";
import { known } from "../model/known.js";
import { theEngine } from "../model/one_ball.js";
import { dropAt, numbersOf as pathsOf, valueIn } from "../model/paths.js";
import { numbersOf } from "../run/result.js";
import { spaced } from "./play.js";

const FLAT = ["mass", "form", "first", "second", "third", "fourth", "gap", "velocity"];

/** Return the values along a side, evenly spaced or in equal ratios. */
export function spread({ low, high, count, log }) {
  for (const [name, value] of [["low", low], ["high", high]]) {
    if (log && value <= 0) throw new InvalidValue(`${name} must be above 0 on a logarithmic scale, got ${general(value)}`);
  }
  if (low === high) throw new InvalidValue(`high must differ from low, got ${general(high)} twice`);
  const exponents = log && spaced(Math.log10(low), Math.log10(high), count);
  const values = log ? exponents.map((power) => 10 ** power) : spaced(low, high, count);
  [values[count - 1], values[0]] = [high, low]; // to their last bits
  if (values.every(Number.isFinite)) return values;
  throw new InvalidValue(`low and high must be nearer to each other, got ${general(low)} and ${general(high)}`);
}

/** Raise where a path is none of those that can vary. */
export function checkPath(path, paths) {
  if (!paths.some((number) => number.path === path)) throw new InvalidValue(`${path} is not a parameter of this drop`);
}

/** Drops with the values of one side, x, or of two, x and y: `sides` has `{path, values}` of each. */
export class Points {
  constructor(drop, sides) {
    Object.assign(this, { drop, sides, columns: sides.x.values.length, rows: sides.y?.values.length ?? 1 });
    this.varied = this.vary();
    this.check();
    this.base = numbersOf(drop);
    this.lanes = this.chooseLanes();
    this.changes = this.listChanges();
  }

  /** Return `[{number, dims, at(i, j)}]`: the numbers that vary; a ratio sets the first of its two numbers. */
  vary() {
    const { drop } = this;
    const numbers = pathsOf(drop);
    const arrays = new Map();
    for (const [name, { path, values }] of Object.entries(this.sides)) {
      arrays.set(path, { dims: [name], at: (i, j) => values[name === "x" ? i : j] });
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
    for (const number of numbers) {
      const law = number.part === "contacts" ? this.drop.contacts[number.index] : null;
      const twin = law?.kind.loss_fields.find((field) => field !== number.field);
      const other = numbers.find(({ part, index, field }) => part === number.part && index === number.index && field === twin);
      if (law?.kind.loss_fields[0] !== number.field || !other) continue;
      throw new InvalidValue(`${number.path} and ${other.path}: only one of the two can vary`);
    }
  }

  /** Return the drop of a point, checked. */
  at(i, j) {
    return dropAt(this.drop, this.varied.map((axis) => [axis.number, axis.at(i, j)]));
  }

  /** Raise where a corner's drop is none; where all corners are drops, all points are, but for those in which all balls rest. */
  check() {
    const { drop, columns, rows } = this;
    const [across, up] = drop.velocities ? [spaced(0, columns - 1, columns), spaced(0, rows - 1, rows)] : [[0, columns - 1], [0, rows - 1]];
    for (const i of across) for (const j of up) this.at(i, j);
  }

  /** Return the name of the engine in lanes that can run all drops, if there is one. */
  chooseLanes() {
    const { base, drop, varied } = this;
    const { forms, layout } = theEngine();
    const together = new Set(base.velocity).size === 1 && base.velocity[0] < 0;
    const few = known.limits.events < layout.limits.lanes; // a drop in lanes counts no events
    if (drop.balls.length !== 2 || !together || few || varied.some(({ number }) => number.part === "velocities")) return null;
    const weightless = drop.gravity === 0 && varied.every(({ number }) => number.field !== "gravity");
    const linear = base.form.every((form, i) => layout.linear_forms.includes(form) && base.second[i] === 1);
    if (linear && varied.every(({ number }) => number.field !== "exponent"))
      return weightless && base.form.every((form) => form === forms.POWER) ? "run_two_springs" : "run_linear";
    return base.form.every((form) => layout.pair_forms.includes(form)) ? "run_pairs" : null;
  }

  /** Run so many drops, in the order of rows; return `Outcomes` of them. */
  solve(from, count) {
    const drops = this.list(from, count);
    return new Outcomes(drops, run(drops, this.lanes), this.drop.balls.length);
  }

  /** Return the numbers of some drops as the engine takes them. */
  list(from, count) {
    const { base, columns } = this;
    const drops = { rigid: base.rigid, gravity: repeated([base.gravity], count) };
    for (const name of FLAT) drops[name] = repeated(base[name], count);
    for (const { dims, targets, numbers } of this.changes) {
      const [across, up] = ["x", "y"].map((dim) => dims.includes(dim));
      const places = targets.map(([name, place]) => [drops[name], place, drops[name].length / count]);
      for (let k = 0; k < count; k += 1) {
        const [i, j] = [(from + k) % columns, Math.floor((from + k) / columns)];
        const values = numbers(across ? i : 0, up ? j : 0);
        for (let t = 0; t < places.length; t += 1) places[t][0][k * places[t][2] + places[t][1]] = values[t];
      }
    }
    return drops;
  }

  /** Return `[{dims, targets, numbers(i, j)}]`: which of the engine's numbers change from point to point, and to what. */
  listChanges() {
    const { base, drop, varied } = this;
    const found = [];
    const change = (some, targets, numbers) => {
      const dims = [...new Set(some.flatMap((axis) => axis.dims))];
      found.push({ dims, targets, numbers: dims.length === 1 ? remembered(numbers) : numbers });
    };
    for (const axis of varied) {
      const { part, index } = axis.number;
      const target = { gaps: ["gap", index + 1], velocities: ["velocity", index], balls: ["mass", index] }[part];
      if (target) change([axis], [target], (i, j) => [axis.at(i, j)]);
    }
    drop.contacts.forEach((law, contact) => {
      const own = varied.filter(({ number }) => number.part === "contacts" && number.index === contact);
      const constants = (i, j) => Object.fromEntries(own.map((axis) => [axis.number.field, axis.at(i, j)]));
      const targets = ["first", "second", "third", "fourth"].map((name) => [name, contact]);
      if (own.length) change(own, targets, (i, j) => law.replaced(constants(i, j)).engineNumbers().slice(1));
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
    if (fall.length) change(fall, falls ? targets : targets.slice(0, 1), speeds);
    return found;
  }
}

/** Return an array of some numbers, so many times. */
function repeated(numbers, count) {
  const all = new Float64Array(count * numbers.length);
  if (count) all.set(numbers);
  for (let done = numbers.length; done < all.length; done *= 2) all.copyWithin(done, 0, done);
  return all;
}

/** Return a function of the places along one side that computes each once. */
function remembered(numbers) {
  const found = [];
  return (i, j) => (found[i + j] ??= numbers(i, j)); // one of the two is 0
}

function run(drops, lanes) {
  return theEngine().sweep(drops, { rtol: known.map_rtol, eventLimit: known.limits.events, lanes });
}

/** Run drops of one height that are all rigid, or all not; return `Outcomes` of them. */
export function solveAll(drops) {
  const numbers = drops.map(numbersOf);
  const together = { rigid: drops[0].rigid, gravity: Float64Array.from(numbers, ({ gravity }) => gravity) };
  for (const name of FLAT) together[name] = Float64Array.from(numbers.flatMap((one) => one[name]));
  return new Outcomes(together, run(together, null), drops[0].balls.length);
}

/** What came out of some drops. */
class Outcomes {
  constructor(drops, found, balls) {
    Object.assign(this, { drops, found, balls });
  }

  /** Whether a drop came to its end. */
  finished(row) {
    return this.found.status[row] <= theEngine().statuses.COLLAPSED;
  }

  /** Return an outcome of a drop, such as rebound_ratio of ball 1; null where it did not end or there is none. */
  value(row, name, index, pull = this.pull(row)) {
    const value = this.finished(row) ? this.select(row, name, index, pull) : NaN;
    return Number.isFinite(value) ? value : null;
  }

  /** Return the acceleration in m/s² of a drop's flights. */
  pull(row) {
    return this.drops.gravity[row] || known.gravity;
  }

  select(row, name, index, pull) {
    const { found, drops, balls } = this;
    if (name === "energy_retained") return found.energy_retained[row];
    const place = row * balls + index;
    if (name === "collisions") return found.collisions[place];
    const ratio = found.rebound_ratio[place];
    if (name === "rebound_ratio") return ratio;
    const reference = drops.velocity.subarray(row * balls, (row + 1) * balls).reduce((most, one) => Math.max(most, Math.abs(one)), 0);
    const speed = ratio * reference;
    return (speed * Math.abs(speed)) / (2 * pull);
  }
}
