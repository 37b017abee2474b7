/** What all plots have in common: axes, dots, and a figure with a legend around them. */

import { h } from "../dom.js";
import { LETTERS, onRepaint } from "./palette.js";
import { format } from "../words/words.js";

const LEAST = 40; // px of width, below which nothing is drawn

/** Return uPlot's options; `x` and `y` return the ranges of the axes, whose own settings are in `axes`. */
export function chartOptions(colors, { width, height, padding, x, y, axes, series, hooks }) {
  const axis = { stroke: colors.muted, font: LETTERS, grid: { stroke: colors.line, width: 1 }, ticks: { show: false } };
  return {
    width,
    height,
    padding,
    legend: { show: false },
    cursor: { show: false },
    scales: { x: { time: false, range: x }, y: { range: y } },
    axes: axes.map((own) => ({ ...axis, ...own })),
    series: [{}, ...series],
    hooks,
  };
}

/** Return what writes the ticks of an axis in a unit of some size, which stands at the last of them. */
export function ticksIn(size, unit) {
  const ending = unit ? ` ${unit}` : "";
  return (_, ticks) => ticks.map((tick, i) => format(tick / size, 4) + (i === ticks.length - 1 ? ending : ""));
}

/** Draw inside of a plot's axes only. */
export function clipped({ ctx, bbox: { left, top, width, height } }, paint) {
  ctx.save();
  ctx.beginPath();
  ctx.rect(left, top, width, height);
  ctx.clip();
  paint(ctx);
  ctx.restore();
}

/** Draw values as squares of a size in px, in the colour that is set. */
export function drawDots(plot, xs, ys, px) {
  const size = px * devicePixelRatio;
  ys.forEach((value, i) => {
    if (value === null) return;
    plot.ctx.fillRect(plot.valToPos(xs[i], "x", true) - size / 2, plot.valToPos(value, "y", true) - size / 2, size, size);
  });
}

/** Return an entry of a legend: a swatch of a colour with a look of its own, and what it stands for. */
export function legendItem(color, look, ...children) {
  return h("li", {}, h("span", { class: `swatch ${look}`, "aria-hidden": "true", "--ball": color }), children);
}

/** Return what makes the plot in an element anew; `make(host)` returns the plot, or null where there is nothing to see. */
export function plotIn(host, make) {
  let plot = null;
  const draw = () => {
    plot?.destroy();
    plot = host.clientWidth < LEAST ? null : make(host);
  };
  new ResizeObserver(draw).observe(host);
  onRepaint(draw);
  return draw;
}
