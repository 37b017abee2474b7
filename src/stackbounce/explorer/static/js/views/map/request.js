/** Asks for maps, from coarse to fine. */

import { lawOf } from "../../set_up/laws.js";
import { depends, firstSide, isSide } from "../drawing/sides.js";
import { oneAtATime } from "../../asking/questions.js";

const COARSE = [24, 18];
const MEDIUM = [60, 45];
const FINE = [120, 90]; // at once where two contacts are solved in closed form

/** Return how many points the maps of a drop have along their sides, from coarse to fine; `laws` are the catalogue's. */
function steps(drop, laws) {
  const exact = drop.contacts.every(({ law }) => lawOf(laws, law).exact);
  return exact && drop.balls.length <= 2 ? [FINE] : [COARSE, MEDIUM, FINE];
}

/** Return `{ask(drop, wanted), drop()}`; `tell` hears {settings, paths, shows}, with {drop, answer} as well, or {problem}. */
export function mapper(api, tell) {
  return oneAtATime(async (told, drop, wanted) => {
    const { paths, shows } = await api.mapPaths(drop);
    const settings = complete(wanted, paths, shows, drop);
    told({ settings, paths, shows });
    const { laws } = await api.catalogue();
    const requests = steps(drop, laws).map(([across, up]) => {
      const [x, y] = [{ ...settings.x, count: across }, { ...settings.y, count: up }];
      return { drop, x, y, show: settings.show };
    });
    const found = (answer) => answer && { drop, settings, paths, shows, answer };
    return found(await api.maps(requests, (part) => told(found(part))));
  }, tell);
}

/** Return the settings of a map; defaults replace those that are missing or do not fit the drop. */
function complete(wanted, paths, shows, drop) {
  const known = (side) => (isSide(side) && paths.some(({ path }) => path === side.path) ? side : null);
  const best = (other) => {
    const free = paths.filter(({ path }) => !depends(path, other?.path));
    const first = FIRST.map((kind) => free.find(({ path }) => path.startsWith(kind))).find(Boolean);
    return firstSide(first ?? free[0] ?? paths[0]);
  };
  const x = known(wanted?.x) ?? best(known(wanted?.y));
  const y = known(wanted?.y) && !depends(wanted.y.path, x.path) ? wanted.y : best(x);
  const last = `rebound_ratio.${drop.balls.length - 1}`;
  const show = shows.some((known) => known.show === wanted?.show) ? wanted.show : last;
  return { x, y, show };
}

/** Which numbers are mapped first. */
const FIRST = ["mass_ratio", "stiffness_ratio", "contacts", "balls"];
