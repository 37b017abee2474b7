/** Bars of momentum below the stage: each ball's and their sum, now, before and after the impact. */

import { partsOf, put, s, write } from "../dom.js";
import { t } from "../words/language.js";
import { fixed, shortBall, shortened } from "../words/words.js";

const ROW = 18; // px
const NAMES = 92; // px for the names at the left
const LETTERS = 13; // of a name
const VALUES = 78; // px for the numbers at the right

/** Draw the bars into `root` while the state asks for them, at the clock's time. */
export function mountMomentum(root, store, clock) {
  const { bars: svg } = partsOf(root);
  let bars = null;
  let width = 0;

  const build = () => {
    const { result, momentum } = store.get();
    root.hidden = !momentum || !result;
    if (root.hidden || !clock.film || width < NAMES + VALUES) return;
    bars = barsOf(result.drop, clock.film, width);
    put(svg, "viewBox", `0 0 ${width} ${ROW * bars.rows.length}`);
    put(svg, "height", ROW * bars.rows.length);
    svg.replaceChildren(...bars.rows.flatMap(({ elements }) => elements));
    clock.touch();
  };
  const draw = () => {
    if (root.hidden || !bars || bars.film !== clock.film) return;
    const now = bars.momenta(clock.time);
    bars.rows.forEach(({ bar, value }, row) => {
      const length = now[row] * bars.scale;
      put(bar, "x", (bars.zero + Math.min(0, length)).toFixed(1));
      put(bar, "width", Math.abs(length).toFixed(1));
      if (clock.legible) write(value, fixed(now[row], 3));
    });
  };
  store.watch(["result", "momentum"], build);
  clock.subscribe(draw);
  new ResizeObserver(([{ contentRect }]) => {
    if (contentRect.width !== width) {
      width = contentRect.width;
      build();
    }
  }).observe(root);
}

/** Return the rows of bars of a drop, from the highest ball down, and the sum. */
function barsOf(drop, film, width) {
  const order = drop.balls.map((_, ball) => ball).reverse();
  const momenta = (time) => {
    const { velocity } = film.at(time);
    const each = order.map((ball) => drop.balls[ball].mass * velocity[ball]);
    return [...each, each.reduce((sum, one) => sum + one, 0)];
  };
  const [before, after] = [momenta(0), momenta(film.last)];
  const most = Math.max(1e-9, ...[...before, ...after].map(Math.abs), ...order.map((_, row) => Math.abs(before[row]) * 1.5));
  const room = width - NAMES - VALUES;
  const zero = NAMES + room / 2;
  const scale = room / 2 / most;
  const rows = before.map((_, row) => {
    const y = row * ROW;
    const ball = order[row];
    const look = ball === undefined ? { class: "momentum-bar sum" } : { class: "momentum-bar", "--ball": `var(--ball-${ball % 6})` };
    const bar = s("rect", { ...look, y: y + 3, height: ROW - 6, x: zero });
    const mark = (value, name) => s("line", { class: name, x1: zero + value * scale, x2: zero + value * scale, y1: y + 1, y2: y + ROW - 1 });
    const value = s("text", { x: width - 2, y: y + 13, "text-anchor": "end" });
    const name = s("text", { x: 0, y: y + 13, text: ball === undefined ? t("sum") : shortened(shortBall(drop, ball), LETTERS) });
    const axis = s("line", { class: "momentum-zero", x1: zero, x2: zero, y1: y, y2: y + ROW });
    return { bar, value, elements: [name, bar, axis, mark(before[row], "momentum-before"), mark(after[row], "momentum-after"), value] };
  });
  return { rows, zero, scale, momenta, film };
}
