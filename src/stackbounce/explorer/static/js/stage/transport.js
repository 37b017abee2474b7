/** Playback: play, replay, events, the film's speed, and what the stage shows. */

import { button, h, partsOf, put, write } from "../dom.js";
import { GRAVITY } from "../set_up/drops.js";
import { check, choice } from "../set_up/fields.js";
import { t } from "../words/language.js";
import { format } from "../words/units.js";
import { moment } from "../words/words.js";

const STEPS = 2000; // of the cursor, as its HTML has them
const MAGNIFY = [1, 2, 3, 5, 8, 10, 20, 30, 50];
const STRIDE = 1 / 200; // of the film, that an arrow key moves the cursor; ten times that for a page

/** Let the transport in `root` drive the clock, and follow it. */
export function mountTransport(root, store, clock) {
  const { play, cursor, options, ...others } = partsOf(root);
  mountActions(others, store, clock);
  play.addEventListener("click", toggle);
  cursor.addEventListener("input", () => {
    clock.pause();
    clock.wind((clock.film?.length ?? 0) * (Number(cursor.value) / STEPS));
  });

  function toggle() {
    if (clock.playing) clock.pause();
    else clock.play();
  }
  const move = (part) => {
    clock.pause();
    clock.wind(clock.reel + part * (clock.film?.length ?? 0));
  };
  const keys = {
    ArrowLeft: () => move(-STRIDE),
    ArrowRight: () => move(STRIDE),
    Home: () => move(-1),
    End: () => move(1),
    " ": toggle,
  };
  const ofCursor = { ...keys, ArrowUp: keys.ArrowRight, ArrowDown: keys.ArrowLeft, PageUp: () => move(10 * STRIDE), PageDown: () => move(-10 * STRIDE) };
  document.addEventListener("keydown", (event) => {
    if (store.get().view !== "play" || event.ctrlKey || event.metaKey || event.altKey) return;
    const own = event.target === cursor;
    if (!own && event.target.closest("input, select, textarea, button, summary, a, [role=region], [role=slider]")) return;
    const act = (own ? ofCursor : keys)[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });

  const showOptions = () => options.replaceChildren(...switches(store));
  let played = false;
  clock.subscribe(() => {
    cursor.value = (STEPS * clock.reel) / (clock.film?.length || 1);
    if (!clock.playing) put(cursor, "aria-valuetext", moment(clock.time, store.get().until !== null));
    put(play, "aria-label", clock.playing ? t("Pause") : t("Play"));
    play.classList.toggle("playing", clock.playing);
    if (played && !clock.playing) keep(store, clock);
    played = clock.playing;
  });
  cursor.addEventListener("change", () => keep(store, clock));
  addEventListener("pointerup", () => !clock.playing && keep(store, clock));
  addEventListener("keyup", () => !clock.playing && keep(store, clock));
  store.watch(["until", "magnify", "overlays", "predict", "kept", ...SHOWN.map(([name]) => name)], showOptions);
  store.watch(["result"], ({ result }, before) => Boolean(result?.separate) !== Boolean(before.result?.separate) && showOptions());
  showOptions();
}

/** Keep the cursor's place in the state, and so in the address. */
function keep(store, clock) {
  if (store.get().result) store.set({ t: clock.time });
}

/** Let the row of what is done with the film do it. */
function mountActions({ replay, previous, next, loop, speed: slider, told }, store, clock) {
  const step = (forward) => () => {
    clock.pause();
    clock.step(forward);
    keep(store, clock);
  };
  replay.addEventListener("click", () => clock.replay());
  previous.addEventListener("click", step(false));
  next.addEventListener("click", step(true));
  loop.addEventListener("change", () => store.set({ loop: loop.checked }));
  slider.addEventListener("input", () => store.set({ speed: 2 ** Number(slider.value) })); // its steps are powers of two
  const show = () => {
    const { speed, loop: again } = store.get();
    slider.value = Math.log2(speed);
    loop.checked = again;
    write(told, `×${format(speed, 2)}`);
    put(slider, "aria-valuetext", t("{times} times", { times: format(speed, 2) }));
  };
  store.watch(["speed", "loop"], show);
  show();
}

const SHOWN = [
  ["ghosts", t("Textbook’s balls")],
  ["arrows", t("Velocities")],
  ["momentum", t("Momentum")],
  ["centre", t("Centre of mass")],
  ["sound", t("Sound")],
];

/** Return the row of what the stage shows. */
function switches(store) {
  const { magnify, until, result, overlays, predict, kept } = store.get();
  const hasTextbook = !result || result.separate;
  const parts = SHOWN.filter(([name]) => name !== "ghosts" || hasTextbook).map(([name, text]) =>
    check(text, store.get()[name], (on) => store.set({ [name]: on })),
  );
  parts.push(check(t("Whole drop"), until !== null, (on) => store.set(on ? whole(store.get()) : alone(store.get()))));
  if (until === null) {
    const sizes = [...new Set(magnify === null ? MAGNIFY : [...MAGNIFY, magnify])].sort((a, b) => a - b).map((times) => [times, `×${format(times, 3)}`]);
    const set = (value) => store.set({ magnify: value === "" ? null : Number(value) });
    parts.push(
      check(t("Predict first"), predict, (on) => store.set({ predict: on, guess: null })),
      button(kept ? t("Let go what was kept") : t("Keep this one to compare"), () => store.set({ kept: kept ? null : store.get().result }), { class: "small" }),
      choice({ label: t("Movement"), groups: [["", [["", t("auto")], ...sizes]]], value: magnify ?? "", set }),
    );
  }
  if (until === null && overlays.some(({ what }) => what === "position")) {
    parts.push(h("p", { class: "note", text: t("The measured track is of the whole drop: show that to see it.") }));
  }
  return parts;
}

let before = 0; // m/s², gravity during the impact, when a whole drop was asked for

/** Return the patch that shows falls, bounces and flights: long enough for the highest ball to come down. */
function whole({ drop, result }) {
  const fastest = Math.max(1, ...(result?.rebound_speeds ?? []).filter(Number.isFinite));
  const until = Math.min(Math.ceil((2.4 * fastest) / GRAVITY), 8);
  before = drop.gravity;
  return { until, t: null, drop: { ...drop, gravity: GRAVITY } };
}

function alone({ drop }) {
  return { until: null, t: null, drop: { ...drop, gravity: before } };
}
