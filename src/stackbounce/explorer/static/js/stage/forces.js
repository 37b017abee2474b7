/** Arrows of the forces in the contacts, which grow while these push: up on the ball above, down on what is below. */

import { arrowPath, height } from "./balls.js";
import { between, locate } from "./clock.js";
import { put, s } from "../dom.js";

const LONGEST = 0.9; // radii of the smallest ball, of the largest force of the drop
const LEAST = 6; // px, of an arrow that is drawn
const NEAR = 0.5; // how near the camera is, from where on arrows are shown

/** Fill a group with the arrows of a result; returns `move(view, time, now)`. */
export function drawForces(root, { result, film, floor, middle }) {
  const { time: times, force } = result.frames;
  const most = Math.max(0, ...force.map((values) => values.reduce((one, other) => Math.max(one, other), 0)));
  const arrows = most > 0 && !film.whole ? force.map(() => s("path", { class: "force" })) : [];
  root.replaceChildren(...arrows);
  return (view, time, now) => {
    if (!arrows.length) return;
    const isShown = view.near > NEAR && time >= 0 && time <= film.last;
    put(root, "visibility", isShown ? "visible" : "hidden");
    if (!isShown) return;
    const place = locate(times, time);
    const longest = LONGEST * Math.min(...view.radius);
    arrows.forEach((arrow, contact) => {
      const length = (longest * Math.max(0, between(force[contact], place))) / most;
      const below = contact === 0 ? floor : Number(height(view, floor, contact - 1, now.position[contact - 1])) - view.radius[contact - 1];
      const above = Number(height(view, floor, contact, now.position[contact])) + view.radius[contact];
      put(arrow, "transform", `translate(${middle} ${(0.5 * (below + above)).toFixed(1)})`);
      put(arrow, "d", length < LEAST ? "" : arrowPath(0, -length) + arrowPath(0, length));
    });
  };
}
