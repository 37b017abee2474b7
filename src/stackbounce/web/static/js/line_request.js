/** Asks for lines: while one is computed the newest question waits, and is asked when the first stage is there. */

import { firstSide, isSide } from "./map_axes.js";
import { SHOWS } from "./line_words.js";

/** Which numbers are drawn first. */
const FIRST = ["gaps", "mass_ratio", "contacts", "balls"];

/** Return `{ask(drop, wanted), drop()}`; `tell` hears {settings, paths, unfit, answer} or {problem}. */
export function liner(api, tell) {
  let newest = 0;
  let computing = false; // nothing of the newest question was answered yet
  let waiting = null;
  const begin = async () => {
    const [drop, wanted] = waiting;
    newest += 1;
    waiting = null;
    computing = true;
    const mine = newest;
    const heard = (news) => {
      if (mine !== newest) return;
      tell(news);
      computing = false;
      if (waiting) begin();
    };
    try {
      const { paths } = await api.mapPaths(drop);
      const { settings, unfit } = complete(wanted, paths);
      const request = { drop, x: settings.x, show: settings.show };
      const answer = await api.line(request, (part) => heard({ settings, paths, unfit, answer: part }));
      if (answer) heard({ settings, paths, unfit, answer });
    } catch (error) {
      heard({ problem: error.message });
    }
  };
  const ask = (drop, wanted) => {
    waiting = [drop, wanted];
    if (!computing) begin();
  };
  const drop = () => {
    newest += 1;
    computing = false;
    waiting = null;
  };
  return { ask, drop };
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
