/** The room in which the balls fall: a door, the balls' shadow, and the floor. */

import { put, s } from "../dom.js";

const DOOR = { width: 0.9, height: 2 }; // m, without its number: the ruler counts from the highest ball, not from the floor
const SKIRTING = 0.08; // m
const LEAST = 24; // px, of a door that can be seen
const NARROW = 480; // px, below which the door stands at the wall's end
const DARKEST = 0.3; // of the shadow of a ball on the floor

/** Fill a group with the room of a film; returns `move(view, now)`. */
export function drawRoom(root, { film, floor, foot, width }) {
  if (!film.floor) {
    root.replaceChildren();
    return () => null;
  }
  const door = s("path", { class: "door", d: doorPath(), "vector-effect": "non-scaling-stroke" });
  const skirting = s("rect", { class: "skirting", x: 0, width });
  const shadow = s("ellipse", { class: "shadow", ry: 4, cy: floor + 4 });
  const ground = [s("rect", { class: "ground-fill", x: 0, y: floor, width, height: foot }), s("line", { class: "ground-line", x1: 0, x2: width, y1: floor, y2: floor })];
  root.replaceChildren(skirting, door, ...ground, shadow);
  const at = (width < NARROW ? 0.03 : 0.18) * width;
  return (view, { position }, middle) => {
    const far = Math.max(0, 1 - 3 * view.near);
    const high = DOOR.height * view.scale;
    const fits = high > LEAST && high < floor && !film.whole;
    put(door, "opacity", fits ? far.toFixed(2) : 0);
    put(door, "transform", `translate(${at.toFixed(1)} ${floor}) scale(${view.scale.toFixed(3)})`);
    const strip = Math.min(SKIRTING * view.scale, 14);
    put(skirting, "y", (floor - strip).toFixed(1));
    put(skirting, "height", strip.toFixed(1));
    const above = Math.max(0, view.lift + view.move * position[0]) / view.radius[0];
    put(shadow, "cx", middle);
    put(shadow, "rx", (Math.max(...view.radius) * (0.8 + 0.1 * Math.min(above, 4))).toFixed(1));
    put(shadow, "opacity", (DARKEST / (1 + 0.5 * above)).toFixed(3));
  };
}

/** Return a door in m, its lower left corner at the origin: frame, two panels, handle. */
function doorPath() {
  const { width, height } = DOOR;
  const box = (x, y, w, h) => `M${x} ${-y}h${w}v${-h}h${-w}Z`;
  return box(0, 0, width, height) + box(0.15, 0.2, width - 0.3, 0.7) + box(0.15, 1.1, width - 0.3, 0.7) + `M${width - 0.13} -1.02h.06`;
}
