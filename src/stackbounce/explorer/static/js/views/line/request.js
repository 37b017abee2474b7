/** What a line asks for. */

import { listOffsets } from "../../answers/angles.js";
import { firstSide, isSide } from "../drawing/sides.js";
import { SHOWS } from "./in_words.js";

/** Which numbers are drawn first. */
const FIRST = ["gaps", "mass_ratio", "contacts", "balls"];

/** Return whether a side is how far a ball lies off the middle, which changes the angles alone. */
export function isOffset({ path }) {
  return path.endsWith(".offset");
}

/** Return `{settings, paths, unfit}`: the wanted settings as far as they fit the drop, all numbers across, and the names of what does not fit. */
export function settle(wanted, others, _shows, drop) {
  const paths = [...others, ...listOffsets(drop)];
  const { x, show } = wanted ?? {};
  const unfit = [];
  const fits = isSide(x) && paths.some(({ path }) => path === x.path);
  if (x && !fits) unfit.push(isSide(x) ? x.path : "x");
  if (show !== undefined && !SHOWS.has(show)) unfit.push(show);
  const first = FIRST.map((kind) => paths.find(({ path }) => path.startsWith(kind))).find(Boolean) ?? paths[0];
  const side = fits ? { path: x.path, low: x.low, high: x.high, log: x.log === true } : firstSide(first);
  const straight = SHOWS.has(show) && show !== "angle" ? show : "rebound_ratio";
  return { settings: { x: side, show: isOffset(side) ? "angle" : straight }, paths, unfit };
}
