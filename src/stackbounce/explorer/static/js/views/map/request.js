/** What a map asks for. */

import { lawOf } from "../../set_up/laws.js";
import { depends, firstSide, isSide } from "../drawing/sides.js";

const COARSE = [24, 18];
const MEDIUM = [60, 45];
const FINE = [120, 90]; // at once where two contacts are solved in closed form

/** Return how many points the maps of a drop have along their sides, from coarse to fine; `laws` are the catalogue's. */
function steps(drop, laws) {
  const exact = drop.contacts.every(({ law }) => lawOf(laws, law).exact);
  return exact && drop.balls.length <= 2 ? [FINE] : [COARSE, MEDIUM, FINE];
}

/** Return the last map of a drop; `told` hears the coarser ones. */
export async function mapOf(api, drop, { x, y, show }, told) {
  const { laws } = await api.catalogue();
  const requests = steps(drop, laws).map(([across, up]) => ({ drop, x: { ...x, count: across }, y: { ...y, count: up }, show }));
  return api.maps(requests, told);
}

/** Return `{settings}` of a map; defaults replace those that are missing or do not fit the drop. */
export function settle(wanted, paths, shows, drop) {
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
  return { settings: { x, y, show } };
}

/** Which numbers are mapped first. */
const FIRST = ["mass_ratio", "stiffness_ratio", "contacts", "balls"];
