/** All outcomes of a kind over one number of the drop, from coarse to fine: closely where a curve bends or jumps. */

import { extentOf } from "../extent.js";
import { separate } from "../model/calibration.js";
import { InvalidValue } from "../model/errors.js";
import { known } from "../model/known.js";
import { readDrop } from "../model/schema.js";
import { listNumbers, nameOutcome } from "./maps.js";
import { Points, checkPath, solveAll, spread } from "./points.js";

const BEGIN = 24; // intervals of the first round
const EVEN = 3; // times that all of them are halved
const CLOSE = 6; // times more, where a curve is not straight
const PARTS = BEGIN * 2 ** (EVEN + CLOSE); // of the side: a place is a whole number of them
const MOST = 1200; // points
const STRAIGHT = 1 / 500; // of a curve's range: how far it may lie off its chord
const JUMP = 1 / 50; // of a curve's range, over one part of the side
const STEEP = 5; // times as steep a jump is as the curve beside it
const NOISE = 1e-9; // of the largest value: rounding makes differences of this size

/** A line, computed a slice at a time: `run()` until `finished`. It has an `answer()` whenever a round is `whole`. */
export class LineJob {
  constructor({ drop: mapping, x, show }) {
    this.drop = readDrop(mapping);
    this.paths = listNumbers(this.drop);
    checkPath(x.path, this.paths);
    spread({ ...x, count: 3 }); // whose ends it checks
    this.curves = listCurves(this.drop, show);
    Object.assign(this, { x, show, rows: new Map(), halved: 0 });
    this.begin(Array.from({ length: BEGIN + 1 }, (_, i) => (i * PARTS) / BEGIN));
  }

  begin(places) {
    this.places = places;
    this.points = new Points(this.drop, { x: { path: this.x.path, values: places.map((place) => this.valueAt(place)) } });
    this.from = 0;
    this.whole = false;
  }

  get finished() {
    return this.whole && this.next.length === 0;
  }

  valueAt(place) {
    const { low, high, log } = this.x;
    if (place === 0) return low;
    if (place === PARTS) return high;
    const share = place / PARTS;
    return log ? 10 ** (Math.log10(low) + share * Math.log10(high) - share * Math.log10(low)) : low + (high - low) * share;
  }

  /** Compute so many more points, at most to the end of a round. */
  run(many) {
    if (this.whole) this.begin(this.next);
    const { from, places } = this;
    const count = Math.min(many, places.length - from);
    const own = this.points.solve(from, count);
    const textbook = this.solveSeparate(from, count);
    for (let k = 0; k < count; k += 1) {
      const of = (outcomes, row) => this.curves.map(({ name, index }) => (outcomes ? outcomes.value(row, name, index, own.pull(k)) : null));
      const met = this.drop.balls.map((_, i) => own.value(k, "collisions", i)).join();
      this.rows.set(places[from + k], { own: of(own, k), textbook: of(...textbook[k]), met, open: !own.finished(k) });
    }
    this.from += count;
    this.whole = this.from === places.length;
    if (this.whole) this.next = this.halve();
  }

  /** Solve the textbook's separate collisions of some points: `[outcomes, row]` of each, without outcomes where there are none. */
  solveSeparate(from, count) {
    const drops = Array.from({ length: count }, (_, k) => (this.drop.rigid ? null : separated(this.points.at(from + k, 0))));
    const there = drops.filter(Boolean);
    const outcomes = there.length ? solveAll(there) : null;
    let row = 0;
    return drops.map((drop) => (drop ? [outcomes, row++] : [null, 0]));
  }

  /** Return the middles of the intervals in which a curve is not known well enough. */
  halve() {
    const places = this.sorted();
    const wanted = this.halved < EVEN ? places.slice(1).map((_, i) => i) : this.bent(places);
    this.halved += 1;
    const wide = wanted.filter((i) => places[i + 1] - places[i] > 1);
    if (places.length + wide.length > MOST) return [];
    return wide.map((i) => (places[i] + places[i + 1]) / 2);
  }

  sorted() {
    return [...this.rows.keys()].sort((a, b) => a - b);
  }

  /** Return the intervals beside which a curve is not straight, or over which contacts meet more or less often. */
  bent(places) {
    const found = new Set();
    const met = places.map((place) => this.rows.get(place).met);
    for (let i = 0; i + 1 < places.length; i += 1) if (met[i] !== met[i + 1]) found.add(i);
    for (const values of this.allValues(places)) {
      const least = STRAIGHT * rangeOf(values);
      for (let i = 1; i + 1 < places.length; i += 1) {
        const [left, here, right] = [values[i - 1], values[i], values[i + 1]];
        if ((left === null) !== (here === null)) found.add(i - 1);
        if ((here === null) !== (right === null)) found.add(i);
        if (left === null || here === null || right === null) continue;
        const part = (places[i] - places[i - 1]) / (places[i + 1] - places[i - 1]);
        if (Math.abs(here - left - part * (right - left)) > least) found.add(i - 1).add(i);
      }
    }
    return [...found].sort((a, b) => a - b);
  }

  allValues(places) {
    return ["own", "textbook"].flatMap((whose) => this.curves.map((_, i) => this.valuesOf(whose, i, places)));
  }

  valuesOf(whose, curve, places) {
    return places.map((place) => this.rows.get(place)[whose][curve]);
  }

  answer() {
    const { drop, x, show } = this;
    const places = this.sorted();
    const { label, unit } = this.paths.find(({ path }) => path === x.path);
    const curve = (whose, i) => {
      const values = this.valuesOf(whose, i, places);
      return { values, jumps: findJumps(places, values, show) };
    };
    const textbook = (i) => (places.some((place) => this.rows.get(place).textbook[i] !== null) ? curve("textbook", i) : null);
    return {
      drop: drop.toMapping(),
      x: { path: x.path, label, unit, low: x.low, high: x.high, log: x.log, values: places.map((place) => this.valueAt(place)) },
      show,
      unit: (known.outcomes[show] ?? known.energy)[1],
      curves: this.curves.map(({ index, label: name }, i) => ({ index, label: name, ...curve("own", i), textbook: textbook(i) })),
      unfinished: places.filter((place) => this.rows.get(place).open).length,
    };
  }
}

/** Return the curves of a kind of outcome: one for each ball or contact, or the only one. */
function listCurves(drop, show) {
  const kinds = ["energy_retained", ...Object.keys(known.outcomes)];
  if (!kinds.includes(show)) throw new InvalidValue(`${show} is no outcome`);
  const curve = (path, index) => {
    const [label] = nameOutcome(drop, path);
    return { name: show, index, label };
  };
  if (show === "energy_retained") return [curve(show, null)];
  return drop.balls
    .map((_, i) => i)
    .filter((i) => show !== "collisions" || drop.contacts[i] !== null)
    .map((i) => curve(`${show}.${i}`, i));
}

function separated(drop) {
  try {
    return separate(drop);
  } catch (error) {
    if (error instanceof InvalidValue) return null;
    throw error;
  }
}

/** Return the range of a curve; that of one that is constant but for rounding has no end, so that it is straight. */
function rangeOf(values) {
  const [low, high] = extentOf(values);
  return high - low > NOISE * Math.max(Math.abs(low), Math.abs(high)) ? high - low : Infinity;
}

/** Return the places in a list of values after which the curve jumps: it is far steeper there than on both sides. */
function findJumps(places, values, show) {
  const least = show === "collisions" ? 0.5 : JUMP * rangeOf(values);
  const slope = (i) => {
    const [here, next] = [values[i] ?? null, values[i + 1] ?? null];
    return here === null || next === null ? 0 : Math.abs(next - here) / (places[i + 1] - places[i]);
  };
  const jumps = [];
  for (let i = 0; i + 1 < places.length; i += 1) {
    const apart = places[i + 1] - places[i];
    const sudden = show === "collisions" || slope(i) > STEEP * Math.max(slope(i - 1), slope(i + 1));
    if (apart === 1 && slope(i) > least && sudden) jumps.push(i);
  }
  return jumps;
}
