/** The balls on the stage, and what belongs to them: names, arrows, the paler ones of the textbook and of a kept drop. */

import { inksOf, patternOf, squash } from "./looks.js";
import { put, s, write } from "../dom.js";
import { spread } from "./labels.js";
import { t } from "../words/language.js";
import { clamp, flattening, outline } from "./shape.js";
import { ballName, fixed, shortened } from "../words/words.js";

const ARROW = 46; // px of the fastest ball's arrow
const STILL = 0.005; // m/s, the speed below which none is written
const HEAD = 58; // px from the top of the stage, below its title
const NEAR = 0.15; // how near the camera is, from where on speeds are written: in fall and leap the marks have their place
const LANE = 8; // px between the arrows of balls that are drawn small
const MOVED = 3; // px from its place, from where a line leads from a name to its ball
const LETTERS = 22; // of a name
const OUTSIDE = 1e4; // px to the side, at most, that a ball is drawn
const WIDE = 0.42; // of its line, that a letter is wide: a name stays on the stage

/** Return a group that shows a ball. */
export function ballGroup(drop, ball) {
  const group = s("g", { class: "ball", "data-ball": ball, "--ball": `var(--ball-${ball % 6})` });
  const name = s("text", { class: "ball-name", "text-anchor": "end", y: 4, text: shortened(ballName(drop, ball), LETTERS) });
  group.append(
    s("path", { class: "ball-body" }),
    patternOf(group, drop.balls[ball]),
    s("path", { class: "ball-light", fill: "url(#light)" }),
    s("path", { class: "ball-arrow" }),
    name,
    s("text", { class: "ball-speed" }),
    s("path", { class: "ball-leader" }),
  );
  return group;
}

/**
 * Move the groups of a drop's balls to where `moment` has them in a view, and the textbook's, `ghosts` with their positions, or
 * null. Words are `letter` px high.
 */
export function moveBalls(groups, moment, { view, floor, middle, fastest, legible, lies, letter, whole }, [ghosts, theirs]) {
  const speaks = whole || view.near > NEAR;
  const flat = flattening(moment.compression, view);
  const places = moment.position.map((position, ball) => Number(height(view, floor, ball, position)));
  const across = moment.position.map((_, ball) => middle + besideOf(view, moment, ball));
  const ghost = theirs ? [moveGhosts(ghosts, theirs, { view, floor, middle })] : [];
  const names = spread([...places, ...ghost], letter, floor - 0.5 * letter);
  put(ghosts, "visibility", theirs ? "visible" : "hidden");
  const speeds = spread(places, letter, floor - 0.5 * letter);
  const widest = Math.max(...view.radius);
  if (theirs) put(ghosts.lastChild, "transform", `translate(${(middle - view.radius.at(-1) - 10).toFixed(1)} ${(names.at(-1) + 4).toFixed(1)})`);
  groups.forEach((group, ball) => {
    const [body, pattern, light, arrow, name, speed, leader] = group.children;
    const radius = view.radius[ball];
    const { path, side } = outline(radius, flat[ball]);
    const velocity = moment.velocity[ball];
    const down = names[ball] - places[ball];
    const isMoved = Math.abs(down) > MOVED;
    const column = Math.max(isMoved ? -widest - 24 : -side - 10, WIDE * letter * name.textContent.length - across[ball]);
    const isAside = Math.abs(across[ball] - middle) > widest;
    const lane = side + 17 + LANE * ball * (1 - view.near);
    put(group, "data-position", moment.position[ball]);
    put(group, "transform", `translate(${across[ball]} ${places[ball].toFixed(2)})`);
    put(body, "d", path);
    put(light, "d", path);
    squash(pattern, side, radius - flat[ball].upper, radius - flat[ball].lower);
    put(arrow, "d", Math.abs(velocity) < STILL ? "" : arrowPath(lane.toFixed(1), (-ARROW * velocity) / fastest));
    put(name, "text-anchor", isAside ? "middle" : "end");
    put(name, "x", isAside ? 0 : column.toFixed(1));
    put(name, "y", (isAside ? -radius - 6 : down + 4).toFixed(1)); // not over the balls that it left
    put(leader, "d", isMoved && !isAside ? `M${(-side - 2).toFixed(1)} 0L${(column + 3).toFixed(1)} ${down.toFixed(1)}` : "");
    put(speed, "x", (lane + 11 + LANE * (groups.length - 1 - ball) * (1 - view.near)).toFixed(1));
    put(speed, "y", (speeds[ball] - places[ball] + 4).toFixed(1));
    if (legible) write(speed, !speaks || lies(ball) || Math.abs(velocity) < STILL ? "" : `${fixed(velocity, 2)} m/s`);
    put(group, "class", lies(ball) ? "ball lies" : "ball");
  });
}

/** Return a ball's height in px on the stage, at a position in m from its place in the stack. */
export function height(view, floor, ball, position) {
  return (floor - view.lift - view.rest[ball] - view.move * position).toFixed(2);
}

/** Return how far a ball is off the middle on the stage, in px: what it has moved is shown as much larger as its height. */
export function besideOf({ scale, move }, { sideways, begun }, ball) {
  return sideways ? Number(clamp(scale * begun[ball] + move * (sideways[ball] - begun[ball]), -OUTSIDE, OUTSIDE).toFixed(2)) : 0;
}

/** Return an arrow from a height of 0 to `length` px down, at `x`. */
export function arrowPath(x, length) {
  if (Math.abs(length) < 1.5) return "";
  const head = clamp(length, -5, 5);
  const tip = length.toFixed(1);
  return `M${x} 0V${tip}m-4 ${-head}L${x} ${tip}l4 ${-head}`;
}

/** Return the textbook's balls, pale, and the name of the highest. */
export function ghostGroup(drop) {
  const circles = drop.balls.map((_, ball) => s("circle", { class: "ghost", "data-ghost": ball, "--ball": `var(--ball-${ball % 6})` }));
  return [...circles, s("text", { class: "ghost-name", "text-anchor": "end", text: t("textbook") })];
}

/** Move the textbook's balls to their positions in m; returns the height of their name in px. */
function moveGhosts(group, positions, { view, floor, middle }) {
  positions.forEach((position, ball) => {
    const circle = group.children[ball];
    put(circle, "r", view.radius[ball].toFixed(2));
    put(circle, "transform", `translate(${middle} ${height(view, floor, ball, position)})`);
  });
  const top = positions.length - 1;
  const y = Number(height(view, floor, top, positions[top]));
  write(group.lastChild, y < 0 ? t("textbook ↑") : t("textbook"));
  return Math.max(HEAD, y);
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
    put(body, "transform", `translate(${middle + besideOf(view, moment, ball)} ${height(view, floor, ball, moment.position[ball])})`);
  });
}
