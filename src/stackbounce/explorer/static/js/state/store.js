/** One observable state for the whole page. */

import { safely } from "../failure.js";

/** The views, in the order of their tabs. */
export const VIEWS = ["play", "line", "map", "measure", "paper"];

/** The name of the list of lessons, in place of a lesson's. */
export const LESSON_LIST = "all";

/** The state at the start: balls of a class that touch, for which the textbook errs (the example class-touching). */
export const FIRST_DROP = {
  balls: [
    { mass: 0.625, diameter: 0.24350706293059987, name: "big basketball" },
    { mass: 0.057, diameter: 0.066, name: "tennis ball" },
  ],
  contacts: [
    { law: "Hysteretic", stiffness: 72945.26409712277, exponent: 1, restitution: 0.81 },
    { law: "Hysteretic", stiffness: 19063.754044362948, exponent: 1, restitution: 0.7665585146050968 },
  ],
  gaps: [0],
  height: 1,
  gravity: 0,
};

/** The paper's basketball and tennis ball (Fig. 9), of which a record for a try is made. */
export const PAPER_DROP = {
  balls: [
    { mass: 0.15, diameter: 0.16, name: "basketball" },
    { mass: 0.057, diameter: 0.066, name: "tennis" },
  ],
  contacts: [
    { law: "Spring", stiffness: 2500 },
    { law: "Spring", stiffness: 1000 },
  ],
  gaps: [0],
  impact_speed: 3.53,
  gravity: 0,
};

export const FIRST = {
  closer: true, // the whole page; else film and sentence alone, for the first minute
  view: "play",
  lesson: null, // the name of the lesson that is open
  lang: null, // the code of the language that was chosen by hand
  drop: FIRST_DROP,
  until: null, // s of the whole drop, or null for the impact alone
  ghosts: true,
  arrows: true, // velocities on the stage
  forces: true, // in the contacts, as arrows
  momentum: false, // bars below it
  centre: false, // of mass
  sound: false, // a knock at each contact
  speed: 1, // of the film
  loop: false,
  predict: false, // first a guess, then the film
  guess: null, // m that the highest ball was thought to rise, once the film has shown it; NaN where nobody guessed
  kept: null, // the result of a drop to compare with
  magnify: null, // how many times movement is shown larger, null to let the page choose
  t: null, // s, where the cursor stands, null for the beginning
  line: null, // {x, show}, null to let the page choose
  map: null,
  errors: {}, // of numbers of the drop, by path: SI numbers, or texts that the server reads
  result: null,
  resultOf: null, // {drop, until} that the result belongs to
  prediction: null, // what follows of the errors, or {problem}
  busy: false,
  error: null, // {detail, offline}
  notice: null, // one line about the page itself, such as a link that could not be read
  replay: 0, // raised where a drop is to be shown from its beginning
  visits: 0, // raised where the browser's Back is to lead to the drop before
  notes: [], // by contact: what became of it at the last change of balls or laws
  overlays: [],
  file: null, // that was dropped on the page, to be measured
};

/** Return what changes in a state that shows another drop from its beginning: its impact, without errors. */
export function withExample({ replay, visits }, drop) {
  const shown = { until: null, t: null, guess: null };
  return { drop, errors: {}, notes: [], ...shown, replay: replay + 1, visits: visits + 1 };
}

/** Return a store: `get()`, `set(patch)`, `subscribe(listener)`, `watch(names, listener)`, `derive(follows)`. */
export function createStore(first = {}) {
  let state = { ...FIRST, ...first };
  const listeners = new Set();
  const derivations = new Set();
  const get = () => state;
  /** Merge a patch, and what follows of it at once, and tell everybody once, with the state and the one before. */
  const set = (patch) => {
    const before = state;
    if (Object.entries(patch).every(([name, value]) => before[name] === value)) return;
    state = { ...state, ...patch };
    for (const follows of derivations) state = { ...state, ...follows(state, before) };
    for (const listener of [...listeners]) safely(listener, state, before);
  };
  /** Call a listener with (state, before) after each change; returns what ends that. */
  const subscribe = (listener) => {
    listeners.add(listener);
    return () => listeners.delete(listener);
  };
  /** Call a listener with (state, before) after each change of some of the state's members. */
  const watch = (names, listener) =>
    subscribe((now, before) => {
      if (names.some((name) => now[name] !== before[name])) listener(now, before);
    });
  /** Let a function of (state, before) return what else changes with each change, before anybody hears of it. */
  const derive = (follows) => derivations.add(follows);
  return { get, set, subscribe, watch, derive };
}
