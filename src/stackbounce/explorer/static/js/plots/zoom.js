/** The range of time that all plots show: the whole, or a part around the cursor. */

import { partsOf, write } from "../dom.js";

const MOST = 64; // times larger than the whole
const STEP = 2;
const AHEAD = 0.1; // of the range lies behind the cursor when the range follows it

export class PlotZoom {
  /** @param {() => number[]} extent the begin and end of what is plotted, in s @param {() => void} redraw of all plots */
  constructor(root, clock, extent, redraw) {
    Object.assign(this, { clock, extent, redraw, times: 1, from: null }, partsOf(root));
    write(this.out, "−");
    write(this.in, "+");
    this.out.addEventListener("click", () => this.set(this.times / STEP));
    this.in.addEventListener("click", () => this.set(this.times * STEP));
    this.all.addEventListener("click", () => this.set(1));
    clock.subscribe(() => this.follow());
    this.show();
  }

  /** Return the range in s. */
  range() {
    const [begin, end] = this.extent();
    if (this.times === 1) return [begin, end];
    const span = (end - begin) / this.times;
    const from = Math.min(Math.max(this.from, begin), end - span);
    return [from, from + span];
  }

  /** Show a part of the whole, so many times larger, around the cursor. */
  set(times) {
    const [begin, end] = this.extent();
    this.times = Math.min(Math.max(times, 1), MOST);
    this.from = this.clock.time - (end - begin) / this.times / 2;
    this.show();
    this.redraw();
  }

  /** Move the range where the cursor has left it. */
  follow() {
    if (this.times === 1) return;
    const { time } = this.clock;
    const [begin, end] = this.extent();
    const [from, to] = this.range();
    if ((time >= from && time <= to) || time < begin || time > end) return;
    this.from = time - (time > to ? AHEAD : 1 - AHEAD) * (to - from);
    this.redraw();
  }

  show() {
    this.out.disabled = this.all.disabled = this.times === 1;
    this.in.disabled = this.times === MOST;
  }
}
