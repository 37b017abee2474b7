/** Play, the cursor, slow motion, and what the stage shows. */

import { h, put, write } from "./dom.js";
import { GRAVITY } from "./drops.js";
import { choice } from "./fields.js";
import { FIRST } from "./store.js";
import { moment } from "./words.js";

const STEPS = 2000; // of the cursor
const SLOW = [10000, 3000, 1000, 300, 100, 30, 10, 3, 1];
const MAGNIFY = [1, 2, 3, 5, 8, 10, 20, 30, 50];
const LIFE = 1; // how many times slower a whole drop is shown
const STRIDE = 1 / 200; // of the window, that an arrow key moves the cursor; ten times that for a page

/** Build the transport into `root`; it drives the clock, and follows it. */
export function mountTransport(root, store, clock) {
  const play = h("button", { type: "button", class: "play", "aria-label": "Play", onclick: toggle });
  const cursor = h("input", {
    type: "range",
    class: "cursor",
    min: 0,
    max: STEPS,
    step: "any",
    value: 0,
    "aria-label": "Time",
    "aria-describedby": "keys",
    oninput: () => {
      clock.pause();
      clock.seek(clock.begin + (clock.end - clock.begin) * (Number(cursor.value) / STEPS));
    },
  });
  const readout = h("output", { class: "readout", "aria-live": "off" });
  const options = h("div", { class: "options" });
  root.replaceChildren(h("div", { class: "transport-main" }, play, cursor, readout), options);

  function toggle() {
    if (clock.playing) clock.pause();
    else clock.play();
  }
  const act = (key) => {
    const stride = STRIDE * (clock.end - clock.begin);
    const moves = {
      ArrowLeft: () => clock.seek(clock.time - stride),
      ArrowRight: () => clock.seek(clock.time + stride),
      Home: () => clock.seek(clock.begin),
      End: () => clock.seek(clock.end),
    };
    if (key === " ") toggle();
    else if (moves[key]) {
      clock.pause();
      moves[key]();
    } else return false;
    return true;
  };
  document.addEventListener("keydown", (event) => {
    if (store.get().view !== "play" || event.ctrlKey || event.metaKey || event.altKey) return;
    const own = event.target === cursor;
    const pages = { PageUp: 10 * STRIDE, PageDown: -10 * STRIDE };
    if (own && pages[event.key]) {
      event.preventDefault();
      clock.pause();
      clock.seek(clock.time + pages[event.key] * (clock.end - clock.begin));
      return;
    }
    if (!own && event.target.closest("input, select, textarea, button, summary, a, [role=region]")) return;
    const key = own ? { ArrowUp: "ArrowRight", ArrowDown: "ArrowLeft" }[event.key] ?? event.key : event.key;
    if (act(key)) event.preventDefault();
  });

  const showOptions = () => options.replaceChildren(...choices(store));
  let shown = "";
  clock.subscribe(() => {
    const whole = store.get().until !== null;
    cursor.value = (STEPS * (clock.time - clock.begin)) / (clock.end - clock.begin || 1);
    const text = moment(clock.time, whole);
    write(readout, text);
    if (!clock.playing) put(cursor, "aria-valuetext", text);
    put(play, "aria-label", clock.playing ? "Pause" : "Play");
    play.classList.toggle("playing", clock.playing);
    const state = `${clock.playing}`;
    if (state !== shown && !clock.playing) keep(store, clock);
    shown = state;
  });
  cursor.addEventListener("change", () => keep(store, clock));
  addEventListener("pointerup", () => !clock.playing && keep(store, clock));
  addEventListener("keyup", () => !clock.playing && keep(store, clock));
  store.subscribe((state, before) => {
    const changed = ["until", "ghosts", "slow", "magnify", "overlays"].filter((name) => state[name] !== before[name]);
    if (changed.length === 0 && Boolean(state.result?.separate) === Boolean(before.result?.separate)) return;
    clock.rate = 1 / state.slow;
    showOptions();
  });
  clock.rate = 1 / store.get().slow;
  showOptions();
}

/** Keep the cursor's place in the state, and so in the address. */
function keep(store, clock) {
  if (store.get().result) store.set({ t: clock.time });
}

function choices(store) {
  const { slow, magnify, ghosts, until, result, overlays } = store.get();
  const numbers = (list, own) => [...new Set(own === null ? list : [...list, own])].sort((a, b) => a - b);
  const speeds = numbers(SLOW, slow).map((one) => [one, one === 1 ? "real time" : `${one}× slower`]);
  const sizes = numbers(MAGNIFY, magnify).map((one) => [one, `×${one}`]);
  const boxes = [
    choice({ label: "Shown", groups: [["", speeds]], value: slow, set: (value) => store.set({ slow: Number(value) }) }),
  ];
  if (until === null) {
    boxes.push(
      choice({
        label: "Movement",
        groups: [["", [["", "auto"], ...sizes]]],
        value: magnify ?? "",
        set: (value) => store.set({ magnify: value === "" ? null : Number(value) }),
      }),
    );
  }
  boxes.push(check("Whole drop", until !== null, (on) => store.set(on ? whole(store.get()) : alone(store.get()))));
  if (until === null && overlays.some(({ what }) => what === "position")) {
    boxes.push(h("p", { class: "note", text: "The measured track is of the whole drop: show that to see it." }));
  }
  if (!result || result.separate) {
    boxes.push(check("Textbook’s balls", ghosts, (on) => store.set({ ghosts: on })));
  }
  return boxes;
}

function check(text, checked, set) {
  const box = h("input", { type: "checkbox", checked, onchange: (event) => set(event.target.checked) });
  return h("label", { class: "check" }, box, text);
}

let before = 0; // m/s², gravity during the impact, when a whole drop was asked for

/** Return the patch that shows falls, bounces and flights: long enough for the highest ball to come down. */
function whole({ drop, result }) {
  const fastest = Math.max(1, ...(result?.rebound_speeds ?? []).filter(Number.isFinite));
  const until = Math.min(Math.ceil((2.4 * fastest) / GRAVITY), 8);
  before = drop.gravity;
  return { until, slow: LIFE, t: null, drop: { ...drop, gravity: GRAVITY } };
}

function alone({ drop }) {
  return { until: null, slow: FIRST.slow, t: null, drop: { ...drop, gravity: before } };
}
