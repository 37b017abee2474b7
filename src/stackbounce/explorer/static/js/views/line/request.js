/** Asks for lines, from coarse to fine. */

import { firstSide, isSide } from "../drawing/sides.js";
import { SHOWS } from "./in_words.js";
import { oneAtATime } from "../../asking/questions.js";

/** Which numbers are drawn first. */
const FIRST = ["gaps", "mass_ratio", "contacts", "balls"];

/** Return `{ask(drop, wanted), drop()}`; `tell` hears {drop, settings, paths, unfit, answer} or {problem}. */
export function liner(api, tell) {
  return oneAtATime(async (told, drop, wanted) => {
    const { paths } = await api.mapPaths(drop);
    const { settings, unfit } = complete(wanted, paths);
    const request = { drop, x: settings.x, show: settings.show };
    const found = (answer) => answer && { drop, settings, paths, unfit, answer };
    return found(await api.line(request, (part) => told(found(part))));
  }, tell);
}

/** Return `{settings, unfit}`: the wanted settings as far as they fit the drop, and the names of the others. */
function complete(wanted, paths) {
  const { x, show } = wanted ?? {};
  const unfit = [];
  const fits = isSide(x) && paths.some(({ path }) => path === x.path);
  if (x && !fits) unfit.push(isSide(x) ? x.path : "x");
  if (show !== undefined && !SHOWS.has(show)) unfit.push(show);
  const first = FIRST.map((kind) => paths.find(({ path }) => path.startsWith(kind))).find(Boolean) ?? paths[0];
  const side = fits ? { path: x.path, low: x.low, high: x.high, log: x.log === true } : firstSide(first);
  return { settings: { x: side, show: SHOWS.has(show) ? show : "rebound_ratio" }, unfit };
}
