/** The state in the address: a link shows again what it was copied from. */

import { complete, isDrop } from "../set_up/drops.js";
import { t } from "../words/language.js";
import { framed, isLanguage } from "../words/language_choice.js";
import { FIRST, LESSON_LIST, VIEWS } from "./store.js";

const DROP = ["balls", "contacts", "gaps", "velocities", "impact_speed", "height", "gravity"];
const WORDS = new Set(["name", "law", "path", "show", "x", "y"]);
const SETTINGS = { line: ["x", "show"], map: ["x", "y", "show"] }; // of a view, by the first part of their paths
const SIDE = ["path", "low", "high", "log"];
const SWITCHES = ["ghosts", "arrows", "forces", "momentum", "centre", "sound", "loop", "predict"];
const GONE = ["slow"]; // what older links have, and no longer means anything
const PART = /^[a-z]+(_[a-z]+)*$/;
const LESSON = /^[a-z]+(-[a-z]+)*$/;
const MOST = 16; // more members than any list of a drop may have
const NAMED = 3; // parts of a link that are named
const LONGEST = 30; // letters of each
const REST = 300; // ms without a change

/** Return a state as the text of a fragment: a drop by the paths of its numbers, as sweeps name them; of the first minute, its language. */
export function write(state) {
  const pairs = state.lang === FIRST.lang ? [] : [["lang", state.lang]];
  if (state.closer) flattenAll(state, pairs);
  return pairs.map(([key, value]) => `${key}=${escape(String(value))}`).join("&");
}

/** List all that a link holds as `[path, member]`. */
function flattenAll(state, pairs) {
  const first = { ...FIRST, predict: asksFirst(state) };
  pairs.unshift(["view", state.view]);
  if (state.lesson !== FIRST.lesson) pairs.push(["lesson", state.lesson]);
  flatten("", state.drop, pairs);
  for (const [path, error] of Object.entries(state.errors)) pairs.push([`error.${path}`, error]);
  if (state.until !== FIRST.until) pairs.push(["until", state.until]);
  for (const name of SWITCHES) if (state[name] !== first[name]) pairs.push([name, Number(state[name])]);
  for (const name of ["speed", "magnify"]) if (state[name] !== FIRST[name]) pairs.push([name, state[name]]);
  if (state.t !== null) pairs.push(["t", Number(state.t.toPrecision(6))]);
  for (const view of Object.keys(SETTINGS)) if (state[view]) flatten(`${view}.`, state[view], pairs);
}

/** Return whether a guess comes first: in a lesson, and in the first minute. */
export function asksFirst({ closer, lesson, view }) {
  return !closer || (![null, LESSON_LIST].includes(lesson) && view === "play");
}

/** Return the patch of the state that a fragment describes; what it does not know is named in `notice`. */
export function read(fragment = framed ? window.name : location.hash) {
  const patch = {};
  const drop = {};
  const settings = {};
  const errors = {};
  const unknown = [];
  const pairs = fragment.replace(/^#/, "").split("&").filter((pair) => pair.indexOf("=") > 0);
  for (const [key, text] of new URLSearchParams(pairs.join("&"))) {
    const parts = key.split(".");
    const taken = DROP.includes(parts[0])
      ? insert(drop, parts, text)
      : Object.hasOwn(SETTINGS, parts[0])
        ? insertSetting(settings, parts, text)
        : parts[0] === "error"
          ? insertError(errors, parts.slice(1), text)
          : readOne(patch, key, text);
    if (!taken) unknown.push(key.slice(0, LONGEST));
  }
  if (isDrop(drop)) Object.assign(patch, { drop: complete(drop), errors });
  else if (Object.keys(drop).length) patch.notice = t("The link holds no whole drop: this is what was here.");
  Object.assign(patch, settings);
  if (unknown.length) {
    const names = unknown.slice(0, NAMED).map((name) => `“${name}”`).join(", ");
    const values = { names, more: unknown.length - NAMED };
    const left =
      values.more > 0
        ? t("This page does not understand {names} and {more} more in the link, and left it out.", values)
        : t("This page does not understand {names} in the link, and left it out.", values);
    patch.notice = [patch.notice, left].filter(Boolean).join(" ");
  }
  patch.closer = pairs.some((pair) => !pair.startsWith("lang="));
  return { predict: asksFirst({ ...FIRST, ...patch }), ...patch };
}

/**
 * Keep the address and the state in step: writes soon after a change, reads when a link is followed. Another view, another
 * lesson and another example are places of their own in the browser's history: its Back undoes them.
 */
export function follow(store) {
  let timer = 0;
  let written = location.hash;
  let way = history.state?.way ?? ""; // a letter for each place before this one: what led on from there
  const put = (state, how = "replaceState") => {
    clearTimeout(timer); // not while numbers change
    timer = 0;
    written = `#${write(state)}`;
    if (framed) window.name = written;
    else history[how]({ way }, "", written === "#" ? location.pathname + location.search : written);
  };
  store.subscribe((state, before) => {
    const beside = ["view", "lesson", "closer"].some((name) => state[name] !== before[name]);
    const step = state.visits !== before.visits ? EXAMPLE : beside ? VIEW : null;
    if (step && !following) {
      put(before);
      way += step;
      put(state, "pushState");
    } else if (state.lang !== before.lang) put(state); // the page is shown anew
    else {
      clearTimeout(timer);
      timer = setTimeout(() => put(store.get()), REST);
    }
  });
  let following = false;
  let passed = ""; // the address that Back or Forward led to
  const show = (patch) => {
    following = true;
    store.set(patch);
    following = false;
    put(store.get());
  };
  addEventListener("popstate", ({ state }) => {
    if (typeof state?.way !== "string") return; // a link was followed
    const [from, to] = [way, state.way].sort((one, other) => one.length - other.length);
    const { lang: _lang, ...found } = read(location.hash); // Back undoes no choice of a language
    way = state.way;
    passed = location.hash;
    const { view = FIRST.view, lesson = FIRST.lesson, closer, predict } = found;
    if (to.slice(from.length).includes(EXAMPLE)) show({ ...FIRST_SHOWN, ...found, lesson });
    else show({ view, lesson, closer, ...(closer ? {} : { predict }) }); // the drop stays as it is now
  });
  addEventListener("hashchange", ({ newURL }) => {
    const { hash } = new URL(newURL); // the page may have written its own address since
    const known = hash === written || hash === passed || !hash.includes("=");
    passed = "";
    if (known) return;
    way += EXAMPLE;
    show({ ...FIRST_SHOWN, ...read(hash), replay: store.get().replay + 1 }); // a lesson stays open
  });
  if (!framed && !history.state) history.replaceState({ way }, "");
}

const EXAMPLE = "e"; // an example was loaded, or a link followed
const VIEW = "v"; // another view, or another lesson

const FIRST_SHOWN = Object.fromEntries(
  ["closer", "view", "until", ...SWITCHES, "guess", "speed", "magnify", "t", "notes", ...Object.keys(SETTINGS)].map((name) => [name, FIRST[name]]),
);

/** List what a value holds as `[path, member]`; `pairs` takes them. */
export function flatten(path, value, pairs) {
  if (value === null || value === undefined) return;
  if (typeof value !== "object") {
    pairs.push([path, value]);
    return;
  }
  const dot = path && !path.endsWith(".") ? `${path}.` : path;
  for (const [key, member] of Object.entries(value)) flatten(dot + key, member, pairs);
}

/** Put a text of the link at its place; tell whether there is such a place. */
function insert(target, parts, text) {
  let place = target;
  for (const [depth, part] of parts.entries()) {
    const index = /^\d+$/.test(part) ? Number(part) : part;
    const fits = Array.isArray(place) ? index < MOST && index <= place.length : PART.test(part);
    if (!fits) return false;
    if (depth === parts.length - 1) {
      place[index] = WORDS.has(part) ? text : number(text);
      return true;
    }
    if (typeof (place[index] ?? {}) !== "object") return false;
    place[index] ??= /^\d+$/.test(parts[depth + 1]) ? [] : {};
    place = place[index];
  }
  return false;
}

/** Take a setting of a view, such as line.x.low; tell whether there is such a one. */
function insertSetting(settings, [view, name, ...rest], text) {
  const fits = rest.length === 0 ? name === "show" : rest.length === 1 && name !== "show" && SIDE.includes(rest[0]);
  return SETTINGS[view].includes(name) && fits && insert((settings[view] ??= {}), [name, ...rest], text);
}

/** Take the error of a number of the drop; tell whether its path is one. */
function insertError(errors, parts, text) {
  if (!parts.length || !parts.every((part) => PART.test(part) || /^\d+$/.test(part))) return false;
  errors[parts.join(".")] = number(text);
  return true;
}

/** Take one setting of the page; tell whether it is one. */
function readOne(patch, key, text) {
  const value = number(text);
  const finite = Number.isFinite(value);
  if (SWITCHES.includes(key)) patch[key] = text !== "0";
  else if (key === "view" && VIEWS.includes(text)) patch.view = text;
  else if (key === "lang" && isLanguage(text)) patch.lang = text;
  else if (key === "lesson" && LESSON.test(text)) patch.lesson = text;
  else if (key === "t" && finite) patch.t = value;
  else if (["until", "speed", "magnify"].includes(key) && finite && value > 0) patch[key] = value;
  else return GONE.includes(key);
  return true;
}

function number(text) {
  if (text === "true" || text === "false") return text === "true";
  return text.trim() !== "" && Number.isFinite(Number(text)) ? Number(text) : text;
}

function escape(text) {
  return encodeURIComponent(text).replaceAll("%20", "+").replaceAll("%2F", "/");
}

export { FIRST_SHOWN };
