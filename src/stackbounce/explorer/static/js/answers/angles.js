/** The angles at which the balls of a drop leave, over how far one of them lies off the middle. */

import { nameBall } from "../model/names.js";
import { readDrop } from "../model/schema.js";
import { leaveSideways } from "../run/sideways.js";
import { runDrop } from "./play.js";
import { checkPath, spread } from "./points.js";

const POINTS = 61;
const DEGREE = Math.PI / 180;

/** Return how far balls may lie off the middle, as `listNumbers` lists numbers; none where a ball has no size. */
export function listOffsets({ balls }) {
  if (!balls.every(({ diameter }) => diameter)) return [];
  return balls.slice(1).map(({ offset = 0 }, i) => ({ path: `balls.${i + 1}.offset`, label: `offset of ${nameBall({ balls }, i + 1)}`, unit: "m", value: offset }));
}

/** A line of one run, as first order is linear: it has its `answer()` at once. */
export class AngleJob {
  finished = true;

  constructor({ drop: mapping, x }) {
    this.drop = readDrop(mapping);
    this.offsets = listOffsets(this.drop);
    checkPath(x.path, this.offsets);
    this.x = x;
  }

  answer() {
    const { drop, x, offsets } = this;
    const values = spread({ ...x, count: POINTS });
    const moved = Number(x.path.split(".")[1]);
    const result = runDrop(drop, null);
    const found = leaveSideways(result, values.map((value) => drop.balls.map(({ offset }, ball) => (ball === moved ? value : offset ?? 0))));
    const curve = (ball) => found.map(({ angle }) => (result.speeds[ball] > 0 ? angle[ball] / DEGREE : null));
    const { label, unit } = offsets.find(({ path }) => path === x.path);
    return {
      drop: drop.toMapping(),
      x: { ...x, label, unit, values },
      show: "angle",
      unit: "°",
      curves: drop.balls.map((_, index) => ({ index, values: curve(index), jumps: [], textbook: null })),
      unfinished: 0,
    };
  }
}
