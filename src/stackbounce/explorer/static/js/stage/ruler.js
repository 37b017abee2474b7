/** The ruler beside the balls: heights of the highest ball above where it lay, and marks at the tops of all. */

import { put, s } from "../dom.js";
import { t } from "../words/language.js";
import { ballName, format, metres } from "../words/words.js";

const APART = 44; // px between two lines, at least
const STEPS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 1e3, 1e4];
const NARROW = 320; // px, below which the words of marks would lie over the balls
const SLIM = 480; // px, below which the highest ball's words would lie over its speed if they stood above their line
const [ABOVE, BELOW] = [-4, 14]; // px, of words from their line
const BESIDE = 56; // px from the right edge: marks have their words left of the ruler's

/** Fill a group with the lines of a film's ruler; returns `move(view, time)`. */
export function drawRuler(root, { film, camera, result, floor, width, middle }) {
  const { drop } = result;
  const top = drop.balls.length - 1;
  const base = ({ lift, rest, radius }) => floor - lift - rest[top] + radius[top];
  const line = (height, name, text) => {
    const tick = name === "tick";
    const [x, x1, y] = [width - (tick ? 8 : BESIDE), tick ? 0 : middle, !tick && width < SLIM ? BELOW : ABOVE];
    return { group: lineOf({ name, x, x1, width, text, y }), height, ball: top };
  };
  const step = STEPS.find((apart) => apart * camera.far.move >= APART) ?? 1e5;
  const room = floor - camera.far.rest[top] + camera.far.radius[top] - 30;
  const count = film.floor ? Math.floor(room / (step * camera.far.move)) : 0;
  const lines = Array.from({ length: count }, (_, i) => line(step * (i + 1), "tick", `${format(step * (i + 1), 4)} m`));
  const fallen = film.whole ? 0 : film.at(film.begin).position[0]; // the highest ball has the gaps to fall, too
  const dropped = width < NARROW ? "" : t("dropped from {height}", { height: metres(fallen) });
  if (fallen > 0) lines.push(line(fallen, "mark drop-mark", dropped));
  const marks = film.tops.map((found, ball) => found && { ...found, ball, group: topMark(drop, ball, film.whole ? found.height : result.rebound_heights[ball], width, middle) }).filter(Boolean);
  root.replaceChildren(...[...lines, ...marks].map(({ group }) => group));
  return (view, time) => {
    const shown = Math.max(0, 1 - 4 * view.near);
    put(root, "opacity", shown.toFixed(2));
    if (shown === 0) return;
    const from = base(view);
    for (const { group, height } of lines) put(group, "transform", `translate(0 ${(from - view.move * height).toFixed(1)})`);
    for (const { group, height, ball, time: reached } of marks) {
      const y = floor - view.lift - view.rest[ball] + view.radius[ball] - view.move * height;
      put(group, "transform", `translate(0 ${y.toFixed(1)})`);
      put(group, "visibility", time >= reached ? "visible" : "hidden");
    }
  };
}

/** Return the mark of a ball's top, with the height that the table of the results has. */
function topMark(drop, ball, height, width, middle) {
  const text = width < NARROW ? "" : `${ballName(drop, ball)} ${metres(height)}`;
  const y = width < SLIM && ball === drop.balls.length - 1 ? BELOW : ABOVE;
  const look = { "--ball": `var(--ball-${ball % 6})` };
  return lineOf({ name: "mark top-mark", x: width - BESIDE, x1: middle, width, text, y, look });
}

/** Return a line with its words. */
function lineOf({ name, x, x1, width, text, y, look }) {
  return s("g", { class: name, ...look }, s("line", { x1, x2: width }), s("text", { "text-anchor": "end", x, y, text }));
}
