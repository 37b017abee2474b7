/** Playback: play, replay, events, the film's speed, and what the stage shows. */

import { partsOf, put, write } from "../dom.js";
import { GRAVITY } from "../set_up/drops.js";
import { t } from "../words/language.js";
import { format, moment } from "../words/words.js";

const STEPS = 2000; // of the cursor, as its HTML has them
const MAGNIFY = [1, 2, 3, 5, 8, 10, 20, 30, 50];
const STRIDE = 1 / 200; // of the film, that an arrow key moves the cursor; ten times that for a page

/** Let the transport in `root` drive the clock, and follow it. */
export function mountTransport(root, store, clock) {
  const { play, cursor, ...others } = partsOf(root);
  mountActions(others, store, clock);
  mountSwitches(root, store);
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

/** Let the row of what the stage shows choose it, and follow the state. */
function mountSwitches(root, store) {
  const { textbook, wholeDrop, predictFirst, predict: first, keeper, movement, magnifier, track } = partsOf(root);
  const boxes = [...root.querySelectorAll("[data-switch]")];
  for (const box of boxes) box.addEventListener("change", () => store.set({ [box.dataset.switch]: box.checked }));
  wholeDrop.addEventListener("change", () => store.set(wholeDrop.checked ? whole(store.get()) : alone(store.get())));
  first.addEventListener("change", () => store.set({ predict: first.checked, guess: null }));
  keeper.addEventListener("click", () => store.set({ kept: store.get().kept ? null : store.get().result }));
  magnifier.addEventListener("change", () => store.set({ magnify: magnifier.value === "" ? null : Number(magnifier.value) }));
  const show = (state) => {
    const { magnify, until, result, overlays, predict, kept } = state;
    for (const box of boxes) box.checked = state[box.dataset.switch];
    textbook.hidden = Boolean(result) && !result.separate;
    wholeDrop.checked = until !== null;
    first.checked = predict;
    for (const part of [predictFirst, keeper, movement]) part.hidden = until !== null;
    write(keeper, kept ? t("Let go what was kept") : t("Keep this one to compare"));
    const sizes = [...new Set(magnify === null ? MAGNIFY : [...MAGNIFY, magnify])].sort((a, b) => a - b);
    magnifier.replaceChildren(new Option(t("auto"), ""), ...sizes.map((times) => new Option(`×${format(times, 3)}`, times)));
    magnifier.value = magnify ?? "";
    track.hidden = until !== null || !overlays.some(({ what }) => what === "position");
  };
  store.watch(["until", "magnify", "overlays", "predict", "kept", "result", ...boxes.map(({ dataset }) => dataset.switch)], show);
  show(store.get());
}

let before; // m/s², gravity during the impact, when a whole drop was asked for

/** Return the patch that shows falls, bounces and flights: long enough for the highest ball to come down. */
function whole({ drop, result }) {
  const fastest = Math.max(1, ...(result?.rebound_speeds ?? []).filter(Number.isFinite));
  const gravity = drop.gravity || GRAVITY;
  const until = Math.min(Math.ceil((2.4 * fastest) / gravity), 8);
  before = drop.gravity;
  return { until, t: null, drop: { ...drop, gravity } };
}

function alone({ drop }) {
  return { until: null, t: null, drop: { ...drop, gravity: before ?? drop.gravity } };
}
