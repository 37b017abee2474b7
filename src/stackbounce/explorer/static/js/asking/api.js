/** What the page asks: its own engine for drops and maps, a server for measurements and fits. */

import { AtOnce } from "../engine/at_once.js";
import { Client } from "../engine/client.js";
import { aligned } from "../model/drop.js";
import { pictureOf } from "../plots/export_picture.js";
import { t } from "../words/language.js";
import { hasServer, loadParts, startWorker } from "../origin/web.js";

let loaded = null;

/** Return what the page computes with; what could not be loaded is asked for again the next time. */
function parts() {
  loaded ??= loadParts().catch((error) => {
    loaded = null;
    throw Object.assign(error, { offline: true });
  });
  return loaded;
}

const player = new Client(startWorker, parts); // the drop that is shown
const desk = new Client(startWorker, parts); // maps, lines, and all else
const atOnce = new AtOnce();

/** Start the second worker and the engine in the page, so that nothing has to be loaded later on; `drop` is a drop to try. */
export const prepare = (drop) =>
  Promise.all([
    desk.prepare().catch(() => null), // it is tried again when it is asked
    parts().then((loaded) => atOnce.open(loaded, drop)).catch(() => null), // the workers do without
  ]);

/** Return the balls, laws, cases and limits. */
export async function catalogue() {
  return (await parts()).model;
}

/** Return the result of a drop at once, or null where that would take too long or cannot be. */
export const playAtOnce = (drop, until, frames) => atOnce.play(drop, until, frames);

/** Return the result of the drop that is to be shown; one that is still computed makes room for it. */
export const play = (drop, until, frames) =>
  player.ask("simulate", [drop, until, frames], { newest: true });
export const simulate = (drop, until = null, frames = 1500) => desk.ask("simulate", [drop, until, frames]);
export const stack = (balls, height) => desk.ask("stack", [balls, height]);
export const law = (request) => desk.ask("law", [request]);
export const like = (request) => desk.ask("like", [request]);
export const mapPaths = (drop) => desk.ask("mapPaths", [drop]);

/** Return the last one of some maps; `told` hears the others. A newer call ends it, with null. */
export const maps = (requests, told) => desk.ask("maps", [requests], { told });

/** Return a line; `told` hears its coarser stages. A newer call, or one of `maps`, ends it, with null. */
export const line = (request, told) => desk.ask("lines", [[request]], { told });

/** Return a file (Blob) of a drop: csv, toml, python, svg or png; toml and python have the errors of its numbers. */
export async function exportFile(kind, drop, until = null, errors = {}) {
  if (kind === "svg" || kind === "png") return pictureOf(kind, await simulate(drop, until), until);
  return new Blob([await desk.ask("exportText", [kind, drop, until, errors])], { type: "text/plain; charset=utf-8" });
}

async function ask(path, options) {
  let response;
  try {
    response = await fetch(path, options);
  } catch {
    throw Object.assign(new Error(t("The server does not answer.")), { offline: true });
  }
  if (!response.ok) {
    const body = await response.json().catch(() => ({}));
    const detail = typeof body.detail === "string" ? body.detail : response.statusText;
    const busy = response.status >= 500 || response.status === 429;
    throw Object.assign(new Error(detail || t("The server answered {status}.", { status: response.status })), { offline: busy });
  }
  return response.json();
}

/** Return the addresses of the page that others can type, with their QR codes; none without a server. */
export const places = async () => (hasServer ? (await ask("api/places")).places : []);
export const measureOptions = () => ask("options.json");
export const measure = (form) => ask("api/measure", { method: "POST", body: form });
export const fit = (form) => ask("api/fit", { method: "POST", body: form });

/** Return what follows of the errors of a drop's numbers. */
export async function predict(drop, errors, until = null) {
  if (!hasServer) throw new Error(t("To carry errors forward needs stackbounce itself: “stackbounce app” opens a page that does"));
  return ask("api/predict", {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify({ drop: aligned(drop), errors, until }),
  });
}
