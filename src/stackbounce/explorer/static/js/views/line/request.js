/** What a line asks for. */

import { firstSide, isSide } from "../drawing/sides.js";
import { SHOWS } from "./in_words.js";

/** Which numbers are drawn first. */
const FIRST = ["gaps", "mass_ratio", "contacts", "balls"];

/** Return `{settings, unfit}`: the wanted settings as far as they fit the drop, and the names of the others. */
export function settle(wanted, paths) {
  const { x, show } = wanted ?? {};
  const unfit = [];
  const fits = isSide(x) && paths.some(({ path }) => path === x.path);
  if (x && !fits) unfit.push(isSide(x) ? x.path : "x");
  if (show !== undefined && !SHOWS.has(show)) unfit.push(show);
  const first = FIRST.map((kind) => paths.find(({ path }) => path.startsWith(kind))).find(Boolean) ?? paths[0];
  const side = fits ? { path: x.path, low: x.low, high: x.high, log: x.log === true } : firstSide(first);
  return { settings: { x: side, show: SHOWS.has(show) ? show : "rebound_ratio" }, unfit };
}
