/** Hands on the stage: a ball is dragged to change the height, its gap or its place in the stack, its edge to change its size. */

import { h, write } from "../dom.js";
import { GRAVITY, gapsOf, incidenceOf, speedOf, withSwap, withValue } from "../set_up/drops.js";
import { t } from "../words/language.js";
import { restacked } from "../set_up/restack.js";
import { radii } from "./shape.js";
import { ballName, capital, clean, format } from "../words/words.js";

const STILL = 4; // px that a pointer may move in a click
const HOLD = 300; // ms that a finger rests on a ball before it drags it: before, it scrolls the page
const WIPE = 10; // px that it may move meanwhile
const EDGE = 0.78; // of the radius, from where it is the edge that is dragged
const SMALL = 20; // px, the radius below which a ball has no edge to drag
const HEIGHTS = [0.02, 10]; // m, as the sliders have them
const GAPS = [0, 0.3];
const SIZES = [0.01, 0.4];

/** Let the balls in `root` be dragged; they are the elements with `data-ball`. */
export function mountHands(root, store, clock, api) {
  const says = h("p", { class: "hands-says", hidden: true });
  root.append(says);
  let held = null; // {pointer, ball, x, y, act, waits}

  const tell = (text) => {
    write(says, text ?? "");
    says.hidden = !text;
  };
  const ballAt = (event) => event.target.closest?.("[data-ball]");
  /** Begin to move a ball: the drop is shown from its beginning, and measured once in the next frame. */
  const begin = (group) => {
    clock.rewind();
    held.act = () => null; // until it is measured
    const mine = held;
    requestAnimationFrame(() =>
      requestAnimationFrame(() => {
        if (held === mine) held.act = actOf(store, api, mine, group);
      }),
    );
  };
  /** Let a finger that has rested on a ball drag it. */
  const grasp = () => {
    held.waits = 0;
    begin(root.querySelector(`[data-ball="${held.ball}"]`));
  };
  const letGo = () => {
    const moved = held?.act;
    clearTimeout(held?.waits);
    held = null;
    tell(null);
    if (moved) store.set({ replay: store.get().replay + 1 });
  };

  root.addEventListener("pointerdown", (event) => {
    const group = ballAt(event);
    if (!group || event.button !== 0 || !event.isPrimary || held) return;
    const { left, top, width, height } = group.querySelector(".ball-body").getBoundingClientRect();
    const [dx, dy] = [event.clientX - left - width / 2, event.clientY - top - height / 2];
    held = { pointer: event.pointerId, ball: Number(group.dataset.ball), x: dx, y: event.clientY, far: Math.hypot(dx, dy), act: null };
    held.edge = width / 2 >= SMALL && held.far > EDGE * (width / 2);
    held.sideways = event.clientX;
    if (event.pointerType === "touch") held.waits = setTimeout(grasp, HOLD);
    root.setPointerCapture(event.pointerId);
  });
  root.addEventListener("pointermove", (event) => {
    if (!held || event.pointerId !== held.pointer) return;
    const [right, up] = [event.clientX - held.sideways, held.y - event.clientY];
    if (held.waits && Math.hypot(right, up) > WIPE) letGo();
    if (!held || held.waits || (!held.act && Math.hypot(right, up) < STILL)) return;
    if (!held.act) begin(root.querySelector(`[data-ball="${held.ball}"]`));
    const text = held.act({ right, up });
    if (text) tell(text);
  });
  for (const name of ["pointerup", "pointercancel"]) {
    root.addEventListener(name, (event) => {
      if (held?.pointer !== event.pointerId) return;
      if (name === "pointerup" && !held.act) clock.replay(); // a click lets go of the balls
      letGo();
    });
  }
  root.addEventListener("touchmove", (event) => held?.act && event.preventDefault(), { passive: false }); // the page stays
  root.addEventListener("pointerover", (event) => !held && tell(ballAt(event) ? hint(store.get().drop, Number(ballAt(event).dataset.ball)) : null));
  root.addEventListener("pointerleave", () => !held && tell(null));
}

/** Return what a movement in px changes, a function that returns a sentence on it. */
function actOf(store, api, { ball, edge, far, x }, group) {
  const { drop } = store.get();
  const radius = radii(drop);
  const { width } = group.querySelector(".ball-body").getBoundingClientRect();
  const metres = (px) => (px * 2 * radius[ball]) / width;
  if (edge) return ({ right }) => resize(store, ball, 2 * radius[ball] * Math.max(0, 1 + (Math.sign(x) * right) / far));
  if (ball === 0) return ({ up }) => lift(store, drop, metres(up));
  let swapped = false;
  return ({ up }) => {
    if (swapped) return null;
    const gap = gapsOf(drop)[ball - 1];
    const way = gap + metres(up);
    const below = way < -(radius[ball] + radius[ball - 1]);
    const above = ball < radius.length - 1 && metres(up) > gapsOf(drop)[ball] + radius[ball] + radius[ball + 1];
    if (!below && !above) return part(store, ball, way);
    swapped = true;
    swap(store, api, drop, below ? ball - 1 : ball);
    const values = { ball: capital(ballName(drop, ball)), other: ballName(drop, below ? ball - 1 : ball + 1) };
    return below ? t("{ball} is now below {other}.", values) : t("{ball} is now above {other}.", values);
  };
}

function lift(store, drop, up) {
  if (incidenceOf(drop) === "velocities") return t("Each ball has a speed of its own: change it in the set-up.");
  const gravity = drop.gravity || GRAVITY;
  const height = rounded(speedOf(drop) ** 2 / 2 / gravity + up, HEIGHTS);
  const isHeight = incidenceOf(drop) === "height";
  const value = isHeight ? height : clean(Number(Math.sqrt(2 * gravity * height).toPrecision(4)));
  change(store, isHeight ? "height" : "impact_speed", value);
  return t("Dropped from {height} m.", { height: format(height, 3) });
}

function part(store, ball, way) {
  const { drop } = store.get();
  const gap = rounded(way, GAPS);
  change(store, `gaps.${ball - 1}`, gap);
  return t("{ball} is {gap} mm above {other}.", { ball: capital(ballName(drop, ball)), gap: format(gap * 1e3, 3), other: ballName(drop, ball - 1) });
}

function resize(store, ball, diameter) {
  const size = rounded(diameter, SIZES);
  change(store, `balls.${ball}.diameter`, size);
  return t("{ball} has a diameter of {size} mm. Its mass stays.", { ball: capital(ballName(store.get().drop, ball)), size: format(size * 1e3, 3) });
}

async function swap(store, api, drop, lower) {
  try {
    const [next, notes] = await restacked(api, await api.catalogue(), drop, withSwap({ ...drop, gaps: gapsOf(drop) }, lower));
    store.set({ drop: next, notes });
  } catch (error) {
    store.set({ error: { detail: error.message, offline: Boolean(error.offline) } });
  }
}

/** Set a number of the drop, where it differs. */
function change(store, path, value) {
  const { drop } = store.get();
  const next = withValue({ ...drop, gaps: gapsOf(drop) }, path, value);
  if (JSON.stringify(next) !== JSON.stringify(drop)) store.set({ drop: next });
}

/** Return a length in m between two ends, to three digits or half a millimetre. */
function rounded(value, [low, high]) {
  const inside = Math.min(Math.max(value, low), high);
  return clean(inside < 0.1 ? Math.round(inside * 2e3) / 2e3 : Number(inside.toPrecision(3)));
}

function hint(drop, ball) {
  const values = { ball: ballName(drop, ball) };
  return ball === 0
    ? t("Drag {ball} to change the height, its edge to change its size.", values)
    : t("Drag {ball} to change the gap or the order, its edge to change its size.", values);
}
