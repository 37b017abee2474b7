/** "Predict first": a mark on the ruler that may be dragged to where the highest ball is thought to rise, and *Drop*. */

import { letDrag, partsOf, put, write } from "../dom.js";
import { t } from "../words/language.js";
import { metres } from "../words/words.js";

const ABOVE = 60; // px above the highest mark
const NARROW = 420; // px, below which the mark is told by its height alone
const RULER = 50; // px of its numbers at the right
const STEP = 0.02; // of what the ruler shows, for one press of an arrow

/** Show the mark over the stage in `root` while the state asks for a guess; returns what takes the ruler's place in each frame. */
export function mountGuess(root, store, clock) {
  const { layer: svg, mark, text, go, again } = partsOf(root);
  go.addEventListener("click", letGo);
  again.addEventListener("click", () => {
    store.set({ guess: null });
    mark.focus();
  });
  let height = null; // m, where the mark was put; null until somebody has
  let place = null; // of the ruler in px: {zero, scale, width}, as the stage has it

  let flies = false; // the balls were let go

  const isAsked = () => store.get().predict && store.get().until === null;
  const isOpen = () => isAsked() && store.get().guess === null && !flies;
  const most = () => (place.zero - ABOVE) / place.scale;
  const told = () => (height === null ? t("your guess?") : place.width < NARROW ? metres(height) : t("your guess: {height}", { height: metres(height) }));

  function letGo() {
    const isHere = [go, mark].includes(document.activeElement);
    flies = true;
    show();
    if (isHere) again.closest("section").focus({ preventScroll: true }); // what goes away has the keys no more: they drive the film
    clock.replay();
  }
  /** Take the guess for good as soon as the film has shown the answer. */
  const watch = () => {
    if (!isAsked() || store.get().guess !== null || !place || !clock.film) return;
    if (clock.time >= (clock.film.tops.at(-1)?.time ?? clock.end)) store.set({ guess: height ?? NaN });
    else if (clock.playing && !flies) letGo();
    else if (flies && !clock.playing && clock.time <= clock.begin) {
      flies = false; // rewound: they can be let go again
      show();
    }
  };
  const set = (value) => {
    height = Math.min(Math.max(value, 0), most());
    show();
  };
  const follow = () => {
    if (!place || !isAsked()) return;
    const shown = height ?? 0.5 * most();
    put(mark, "transform", `translate(0 ${(place.zero - place.scale * shown).toFixed(1)})`);
    write(text, told());
    put(mark, "aria-valuemax", most().toFixed(3));
    put(mark, "aria-valuenow", shown.toFixed(3));
    put(mark, "aria-valuetext", told());
  };
  const take = (next) => {
    if (place && ["zero", "scale", "width", "near"].every((name) => next[name] === place[name])) return;
    place = next;
    for (const line of mark.querySelectorAll("line")) put(line, "x2", place.width - RULER);
    put(svg, "opacity", Math.max(0, 1 - 4 * place.near).toFixed(2));
    follow();
  };
  const show = () => {
    const ignored = height === null && !isOpen();
    put(svg, "class", isAsked() && !ignored ? "guess" : "guess hidden");
    put(mark, "class", `guess-mark ${isOpen() ? "" : "fixed"} ${height === null ? "open" : ""}`);
    put(mark, "tabindex", isOpen() ? 0 : -1);
    go.hidden = !isOpen();
    again.hidden = !isAsked() || store.get().guess === null;
    document.body.classList.toggle("guessing", isAsked() && store.get().guess === null);
    follow();
  };
  letDrag(mark, isOpen, (event) => set((place.zero - (event.clientY - svg.getBoundingClientRect().top)) / place.scale));
  mark.addEventListener("touchstart", (event) => isOpen() && event.preventDefault(), { passive: false }); // the page stays
  mark.addEventListener("keydown", (event) => {
    const moves = { ArrowUp: STEP, ArrowRight: STEP, ArrowDown: -STEP, ArrowLeft: -STEP, PageUp: 5 * STEP, PageDown: -5 * STEP };
    const lets = [" ", "Enter"].includes(event.key);
    if (!isOpen() || !(lets || moves[event.key])) return;
    event.preventDefault();
    event.stopPropagation();
    if (lets) letGo();
    else set((height ?? 0.5 * most()) + moves[event.key] * most());
  });
  store.derive(({ predict, guess, drop, closer }, before) => {
    if (!predict || guess === null || drop === before.drop) return null;
    return { guess: closer ? NaN : null }; // another question, or in the whole page a slider, whose effect is to be seen
  });
  store.watch(["predict", "guess", "until", "drop"], ({ drop }, before) => {
    if (drop !== before.drop) height = null;
    flies = false;
    show();
  });
  clock.subscribe(watch);
  show();
  return take;
}
