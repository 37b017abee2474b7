/** Asks for the drawings of a view, from coarse to fine. */

import { oneAtATime } from "../../asking/questions.js";

/**
 * Return `{ask(drop, wanted), drop()}`; `tell` hears {settings, paths, shows, unfit}, with {drop, answer} as well, or {problem}.
 * `settle(wanted, paths, shows, drop)` returns the settings that fit the drop, and the names of those that do not;
 * `draw(drop, settings, told)` the last answer, of which `told` hears the others.
 */
export function drawer(api, tell, settle, draw) {
  return oneAtATime(async (told, drop, wanted) => {
    const choices = await api.mapPaths(drop);
    const form = { ...choices, ...settle(wanted, choices.paths, choices.shows, drop) };
    told(form);
    const found = (answer) => answer && { drop, ...form, answer };
    return found(await draw(drop, form.settings, (part) => told(found(part))));
  }, tell);
}
