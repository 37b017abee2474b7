/** Pointing at a place of a drawing: with a mouse, which can drag the present drop there, with a finger, or with keys. */

import { write } from "../../dom.js";

const STILL = 4; // px that a mouse may move in a click
const LARGE = 10; // steps, for one press of an arrow with Shift
const WAYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] };

/** Return whether a place lies within the sides; it is a list of their parts, each from 0 to 1. */
export function isInside(place) {
  return place.every((part) => part >= 0 && part <= 1);
}

/** Return the nearest place within the sides. */
export function inside(place) {
  return place.map((part) => Math.min(Math.max(part, 0), 1));
}

/** Return the place in a field that an event points at; null where that is none. */
function placeIn(frame, board, event, { sides, margin }, isDragged) {
  const box = board.getBoundingClientRect();
  const all = [(event.clientX - box.left - frame.left) / frame.width, 1 - (event.clientY - box.top - frame.top) / frame.height];
  const place = all.slice(0, sides);
  if (sides === 1 && isDragged) return inside(place); // a line is followed wherever the mouse is
  const near = Math.abs(all[0] - 0.5) <= 0.5 + margin / frame.width;
  return near && isInside(all.slice(1)) ? inside(place) : null;
}

/**
 * Let the board of a view be pointed at; returns what gives the place that is pointed at, or null.
 * @param {object} parts the view's elements @param {object} kind `{sides, margin, step}`: how many sides a place has, how many
 * px beside the field still belong to it, and how far an arrow moves, as a part of a side @param {object} view a `DrawingView`
 */
export function point({ board, live, play }, kind, view, clock) {
  let place = null;
  let held = null; // where the mouse was pressed, and whether it has moved since

  const follow = (event) => {
    if (!view.frame) return;
    place = placeIn(view.frame, board, event, kind, held?.moved);
    view.mark();
  };
  const choose = () => {
    if (!place) return;
    view.play(place);
    play.hidden = true;
  };
  board.addEventListener("pointermove", (event) => {
    if (held) held.moved ||= Math.hypot(...[event.clientX - held.x, event.clientY - held.y].slice(0, kind.sides)) > STILL;
    follow(event);
    if (held?.moved && place) view.store.set({ drop: view.dropAt(place) });
  });
  board.addEventListener("pointerdown", (event) => {
    held = null;
    follow(event);
    if (event.button !== 0 || event.pointerType === "touch" || !place) return; // a finger scrolls the page
    held = { x: event.clientX, y: event.clientY, moved: false };
    board.setPointerCapture(event.pointerId);
  });
  board.addEventListener("pointerleave", (event) => {
    if (event.pointerType !== "mouse" || held) return;
    place = null;
    view.mark();
  });
  board.addEventListener("click", (event) => {
    const dragged = held?.moved;
    held = null;
    follow(event);
    // A finger hides the point that it touches, so a touch only selects; the button plays.
    if (dragged) clock.replay();
    else if (event.pointerType === "touch") play.hidden = !place;
    else choose();
  });
  play.addEventListener("click", choose);
  board.addEventListener("keydown", (event) => {
    const way = WAYS[event.key]?.slice(0, kind.sides);
    const moves = way?.some((step) => step !== 0);
    if (!view.frame || (!moves && !["Enter", "Home", "Escape"].includes(event.key))) return;
    event.preventDefault();
    if (event.key === "Enter") return choose();
    if (event.key === "Escape") place = null;
    else if (!moves || !place) place = inside(view.present());
    else place = inside(place.map((part, i) => part + way[i] * kind.step * (event.shiftKey ? LARGE : 1)));
    view.mark();
    write(live, place ? kind.told(view.news, place) : "");
    play.hidden = !place;
  });
  return () => place;
}
