/** Requests to the server: each returns its answer or throws an Error with a one-line message. */

async function ask(path, options) {
  let response;
  try {
    response = await fetch(path, options);
  } catch {
    throw Object.assign(new Error("The server does not answer."), { offline: true });
  }
  if (!response.ok) {
    const body = await response.json().catch(() => ({}));
    const detail = typeof body.detail === "string" ? body.detail : response.statusText;
    const busy = response.status >= 500 || response.status === 429;
    throw Object.assign(new Error(detail || `The server answered ${response.status}.`), { offline: busy });
  }
  return response;
}

async function get(path) {
  return (await ask(path)).json();
}

function post(path, body) {
  return ask(path, {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(body),
  });
}

async function send(path, body) {
  return (await post(path, body)).json();
}

async function upload(path, form) {
  return (await ask(path, { method: "POST", body: form })).json();
}

export const catalogue = () => get("api/catalogue");
export const simulate = (drop, until = null, frames = 1500) =>
  send("api/simulate", { drop, until, frames });
export const predict = (drop, errors, until = null) => send("api/predict", { drop, errors, until });
export const stack = (balls, height) => send("api/stack", { balls, height });
export const law = (request) => send("api/law", request);
export const like = (request) => send("api/like", request);
export const map = (request) => send("api/map", request);
export const mapPaths = (drop) => send("api/map/paths", { drop });
export const measureOptions = () => get("api/measure/options");
export const measure = (form) => upload("api/measure", form);
export const fit = (form) => upload("api/fit", form);

/** Return a file (Blob) of a drop: csv, toml, python, svg or png. */
export async function exportFile(kind, drop, until = null) {
  return (await post(`api/export/${kind}`, { drop, until })).blob();
}
