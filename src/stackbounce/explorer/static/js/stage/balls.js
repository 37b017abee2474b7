/** The balls on the stage, and what belongs to them: names, arrows, outlines of the textbook's and of a kept drop's. */

import { inksOf, patternOf, squash } from "./looks.js";
import { put, s, write } from "../dom.js";
import { t } from "../words/language.js";
import { clamp, flattening, outline } from "./shape.js";
import { ballName, fixed } from "../words/words.js";

const ARROW = 46; // px of the fastest ball's arrow
const STILL = 0.005; // m/s, the speed below which none is written
const HEAD = 58; // px from the top of the stage, below its title
const LETTERS = 16; // of a name

/** Return a group that shows a ball. */
export function ballGroup(drop, ball) {
  const group = s("g", { class: "ball", "data-ball": ball, "--ball": `var(--ball-${ball % 6})` });
  const name = s("text", { class: "ball-name", "text-anchor": "end", y: 4, text: shortened(ballName(drop, ball)) });
  group.append(
    s("path", { class: "ball-body" }),
    patternOf(group, drop.balls[ball]),
    s("path", { class: "ball-light", fill: "url(#light)" }),
    s("path", { class: "ball-arrow" }),
    name,
    s("text", { class: "ball-speed", y: 4 }),
  );
  return group;
}

function shortened(name) {
  return name.length > LETTERS ? `${name.slice(0, LETTERS - 1)}…` : name;
}

/** Move the groups of a drop's balls to where `moment` has them in a view. */
export function moveBalls(groups, moment, { view, floor, middle, fastest, legible, lies }) {
  const flat = flattening(moment.compression, view);
  groups.forEach((group, ball) => {
    const [body, pattern, light, arrow, name, speed] = group.children;
    const radius = view.radius[ball];
    const { path, side } = outline(radius, flat[ball]);
    const velocity = moment.velocity[ball];
    put(group, "data-position", moment.position[ball]);
    put(group, "transform", `translate(${middle} ${height(view, floor, ball, moment.position[ball])})`);
    put(body, "d", path);
    put(light, "d", path);
    squash(pattern, side, radius - flat[ball].upper, radius - flat[ball].lower);
    put(arrow, "d", arrowPath((side + 17).toFixed(1), (-ARROW * velocity) / fastest));
    put(name, "x", (-side - 10).toFixed(1));
    put(speed, "x", (side + 28).toFixed(1));
    if (legible) write(speed, lies(ball) || Math.abs(velocity) < STILL ? "" : `${fixed(velocity, 2)} m/s`);
    put(group, "class", lies(ball) ? "ball lies" : "ball");
  });
}

/** Return a ball's height in px on the stage, at a position in m from its place in the stack. */
export function height(view, floor, ball, position) {
  return (floor - view.lift - view.rest[ball] - view.move * position).toFixed(2);
}

/** Return an arrow from a height of 0 to `length` px down, at `x`. */
function arrowPath(x, length) {
  if (Math.abs(length) < 1.5) return `M${x} 0m-3 0h6`;
  const head = clamp(length, -5, 5);
  const tip = length.toFixed(1);
  return `M${x} 0V${tip}m-4 ${-head}L${x} ${tip}l4 ${-head}`;
}

/** Return the outlines of the textbook's balls, and the name of the highest. */
export function ghostGroup(drop) {
  const circles = drop.balls.map((_, ball) => s("circle", { class: "ghost", "data-ghost": ball }));
  return [...circles, s("text", { class: "ghost-name", text: t("textbook") })];
}

/** Move the textbook's balls to their positions in m; without positions they are hidden. */
export function moveGhosts(group, positions, { view, floor, middle }) {
  put(group, "visibility", positions ? "visible" : "hidden");
  if (!positions) return;
  const label = group.lastChild;
  positions.forEach((position, ball) => {
    const circle = group.children[ball];
    put(circle, "r", view.radius[ball].toFixed(2));
    put(circle, "transform", `translate(${middle} ${height(view, floor, ball, position)})`);
  });
  const top = positions.length - 1;
  const y = Number(height(view, floor, top, positions[top])) - view.radius[top] - 5;
  write(label, y < 0 ? t("textbook ↑") : t("textbook"));
  put(label, "transform", `translate(${middle} ${Math.max(HEAD, y).toFixed(1)})`);
}

/** Return what shows the balls of a kept drop, paler, and its name. */
export function keptGroups(drop) {
  const inks = inksOf(drop.balls);
  const bodies = inks.map((ink, ball) => s("path", { class: "ball-body", "--ball": ink ?? `var(--place-${ball % 6})` }));
  return [...bodies, s("text", { y: 18, text: t("kept") })];
}

/** Move the balls of a kept drop. */
export function moveKept(group, moment, { view, floor, middle }) {
  const flat = flattening(moment.compression, view);
  put(group.lastChild, "transform", `translate(${middle} ${floor})`);
  view.radius.forEach((_, ball) => {
    const body = group.children[ball];
    put(body, "d", outline(view.radius[ball], flat[ball]).path);
    put(body, "transform", `translate(${middle} ${height(view, floor, ball, moment.position[ball])})`);
  });
}
