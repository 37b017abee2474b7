/** The ruler beside the balls: heights of the highest ball above where it lay, and marks at the tops of all. */

import { put, s } from "../dom.js";
import { t } from "../words/language.js";
import { spread } from "./labels.js";
import { ballName, format, metres } from "../words/words.js";

const APART = 44; // px between two lines, at least
const STEPS = [1, 2, 5, 10]; // times a power of ten
const MOST = 19; // lines above that of nought
const NEAR = 12; // px from a mark, where no line of the ruler stands
const NARROW = 420; // px, below which the words on the drop would lie over the balls
const ABOVE = 4; // px, of words above their line
const BESIDE = 56; // px from the right edge: marks have their words left of the ruler's

/** Return how far apart in m the lines of a ruler are that shows some metres at a scale in px per m. */
export function stepOf(metres, scale) {
  const least = Math.max(APART / scale, metres / MOST);
  const power = 10 ** Math.floor(Math.log10(least));
  return STEPS.find((step) => step * power >= least * (1 - 1e-9)) * power;
}

/** Fill a group with the lines of a film's ruler; returns `move(view, time, isTop)`: whether the highest ball stands at its top. */
export function drawRuler(root, { film, camera, result, floor, width, middle, letter }) {
  const { drop } = result;
  const top = drop.balls.length - 1;
  const base = ({ lift, rest, radius }) => floor - lift - rest[top] + radius[top];
  const line = (height, name, text) => {
    const tick = name === "tick";
    const [x, x1] = [width - (tick ? 8 : BESIDE), tick ? 0 : middle];
    return { group: lineOf({ name, x, x1, width, text }), height, ball: top, time: -Infinity };
  };
  const room = floor - camera.far.rest[top] + camera.far.radius[top] - 30;
  const step = stepOf(room / camera.far.move, camera.far.move);
  const count = film.floor ? Math.floor(room / (step * camera.far.move)) : 0;
  const ticks = Array.from({ length: film.floor ? count + 1 : 0 }, (_, i) => line(step * i, "tick", `${format(step * i, 4)} m`));
  const fallen = film.whole ? 0 : film.at(film.begin).position[0]; // the highest ball has the gaps to fall, too
  const dropped = width < NARROW ? "" : t("dropped from {height}", { height: metres(fallen) });
  const marks = film.tops.map((found, ball) => found && { ...found, ball, group: topMark(drop, ball, film.whole ? found.height : result.rebound_heights[ball], width, middle) }).filter(Boolean);
  const highest = marks.reduce((one, other) => (one && one.height > other.height ? one : other), null);
  const theirs = film.whole ? null : result.separate?.rebound_heights?.[top];
  if (theirs > 0 && highest?.ball === top) marks.unshift({ ...line(theirs, "mark textbook-mark", width < NARROW ? "" : `${t("textbook")} ${metres(theirs)}`), time: highest.time });
  if (fallen > 0) marks.unshift(line(fallen, "mark drop-mark", dropped));
  root.replaceChildren(...[...ticks, ...marks].map(({ group }) => group));
  return (view, time, isTop) => {
    const shown = Math.max(0, 1 - 4 * view.near);
    put(root, "opacity", shown.toFixed(2));
    if (shown === 0) return;
    const from = base(view);
    for (const { group, time: reached } of marks) put(group, "visibility", time >= reached ? "visible" : "hidden");
    const shownMarks = marks.filter(({ time: reached }) => time >= reached);
    const heights = shownMarks.map(({ ball, height }) => floor - view.lift - view.rest[ball] + view.radius[ball] - view.move * height);
    const words = spread(heights.map((y) => y - ABOVE), letter, floor - ABOVE);
    shownMarks.forEach(({ group }, i) => {
      put(group, "transform", `translate(0 ${heights[i].toFixed(1)})`);
      put(group.lastChild, "y", (words[i] - heights[i]).toFixed(1));
    });
    if (highest) highest.group.classList.toggle("reached", isTop);
    for (const { group, height } of ticks) {
      const y = from - view.move * height;
      put(group, "transform", `translate(0 ${y.toFixed(1)})`);
      put(group, "visibility", heights.some((mark) => Math.abs(mark - y) < NEAR) ? "hidden" : "visible");
    }
  };
}

/** Return the mark of a ball's top, with the height that the table of the results has. */
function topMark(drop, ball, height, width, middle) {
  const look = { "--ball": `var(--ball-${ball % 6})` };
  return lineOf({ name: "mark top-mark", x: width - BESIDE, x1: middle, width, text: width < NARROW ? metres(height) : `${ballName(drop, ball)} ${metres(height)}`, look });
}

/** Return a line with its words. */
function lineOf({ name, x, x1, width, text, look }) {
  return s("g", { class: name, ...look }, s("line", { x1, x2: width }), s("text", { "text-anchor": "end", x, y: -ABOVE, text }));
}
