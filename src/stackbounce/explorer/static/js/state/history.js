/** Undo and redo of the drop's numbers: one movement of a slider is one step. */

import { FIRST_SHOWN, flatten } from "./address.js";
import { partsOf } from "../dom.js";
import { FIRST_DROP, withExample } from "./store.js";

const KEPT = ["drop", "errors", "until", "notes"]; // of the state, in a step
const MOST = 200; // steps
const PAUSE = 700; // ms, after which the same number changes in another step
const TYPED = "input:not([type]), input[type=text], input[type=search], textarea, [contenteditable]";

/** Let the buttons in `root` undo and redo, and the keys that do so on any page. */
export function mountHistory(root, store) {
  const { undo, redo, anew } = partsOf(root);
  const steps = record(store, () => show());
  undo.addEventListener("click", steps.undo);
  redo.addEventListener("click", steps.redo);
  anew.addEventListener("click", () => store.set({ ...FIRST_SHOWN, kept: null, view: store.get().view, ...withExample(store.get(), FIRST_DROP) }));
  const show = () => {
    enable(undo, steps.canUndo(), redo);
    enable(redo, steps.canRedo(), undo);
  };
  show();
  addEventListener("keydown", (event) => {
    const act = !event.defaultPrevented && !event.target.closest?.(TYPED) && asked(event);
    if (!act) return;
    event.preventDefault();
    steps[act]();
  });
}

/** Return what keys ask for: "undo", "redo" or null. */
function asked({ key, ctrlKey, metaKey, shiftKey, altKey }) {
  if (!(ctrlKey || metaKey) || altKey) return null;
  const letter = key.toLowerCase();
  if (letter === "z") return shiftKey ? "redo" : "undo";
  return letter === "y" ? "redo" : null;
}

/** Enable or disable a button; the focus of a disabled one goes to the other. */
function enable(button, can, other) {
  const focused = !can && document.activeElement === button;
  button.disabled = !can;
  if (focused) {
    other.disabled = false;
    other.focus();
  }
}

/** Keep the steps of a store: `{undo(), redo(), canUndo(), canRedo()}`; `tell` is called after each change of them. */
function record(store, tell) {
  let done = [];
  let undone = [];
  let held = false; // a button of the mouse or a finger is down: what changes until it is up is one step
  let open = null; // {at, paths}: the step that a change may still join
  let present = taken(store.get());
  store.subscribe(() => {
    const state = store.get(); // a listener before this one may have changed it further
    if (KEPT.every((name) => state[name] === present[name])) return;
    const before = present;
    present = taken(state);
    const paths = changedPaths(present, before);
    if (paths === "" || state.drop === state.result?.drop) return; // the same drop, with numbers in place of texts
    const now = performance.now();
    const joins = open && undone.length === 0 && (open.held ? open.held === held : open.paths === paths && now - open.at < PAUSE);
    if (!joins) done = [...done.slice(1 - MOST), before];
    open = { at: now, paths, held };
    undone = [];
    tell();
  });
  const entered = ({ target, type, key }) => {
    if (target.matches?.(TYPED) && (type === "change" || key === "Enter")) open = null; // each entry is a step
  };
  for (const name of ["change", "keydown"]) addEventListener(name, entered, true);
  let presses = 0;
  const hold = () => {
    held = presses += 1;
    open = null;
  };
  const letGo = () => {
    held = false;
    open = null;
  };
  addEventListener("pointerdown", hold, true);
  for (const name of ["pointerup", "pointercancel"]) addEventListener(name, () => setTimeout(letGo), true);
  const move = (from, to) => {
    const next = from.at(-1);
    if (!next) return;
    from.pop();
    to.push(present);
    open = null;
    present = next;
    store.set({ ...next, t: null, error: null });
    tell();
  };
  return {
    undo: () => move(done, undone),
    redo: () => move(undone, done),
    canUndo: () => done.length > 0,
    canRedo: () => undone.length > 0,
  };
}

function taken(state) {
  return Object.fromEntries(KEPT.map((name) => [name, state[name]]));
}

/** Return the paths of the numbers that differ between two states, with "+" where one is new; empty if none does. */
function changedPaths(state, before) {
  const [now, then] = [numbers(state), numbers(before)];
  const paths = [...new Set([...now.keys(), ...then.keys()])].filter((path) => now.get(path) !== then.get(path));
  return paths.map((path) => `${then.has(path) ? "" : "+"}${path}`).join(" ");
}

function numbers({ drop, errors, until }) {
  const pairs = [];
  flatten("", { drop, errors, until }, pairs);
  return new Map(pairs);
}
