/** Asks for lines, from coarse to fine, with settings that fit the drop. */

import { inTurn } from "./in_turn.js";
import { firstSide, isSide } from "./map_axes.js";
import { SHOWS } from "./line_words.js";

/** Which numbers are drawn first. */
const FIRST = ["gaps", "mass_ratio", "contacts", "balls"];

/** Return `{ask(drop, wanted), drop()}`; `tell` hears {settings, paths, unfit, answer} or {problem}. */
export function liner(api, tell) {
  const answer = async ([drop, wanted], heard) => {
    const { paths } = await api.mapPaths(drop);
    const { settings, unfit } = complete(wanted, paths);
    const told = (line) => line && heard({ settings, paths, unfit, answer: line });
    told(await api.line({ drop, x: settings.x, show: settings.show }, told));
  };
  const { ask, drop } = inTurn(answer, tell);
  return { ask: (...question) => ask(question), drop };
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
