/** The plot of a press curve: force over compression, pressed in and let go, with the fitted lines. */

import uPlot from "../../vendor/uplot/uPlot.esm.js";
import { h } from "../dom.js";
import { t, translated } from "../words/language.js";
import { colorOf, LETTERS, onRepaint, palette } from "./palette.js";
import { format, shownUnit } from "../words/units.js";

const MM = 1e-3; // m

/** Return `{element, show(branches)}`; without branches nothing is shown. */
export function pressPlot() {
  const host = h("div", { class: "record-canvas", role: "img" });
  const legend = h("ul", { class: "legend" });
  const title = h("h3", { text: t("Force over compression") });
  const element = h("figure", { class: "record", hidden: true }, h("figcaption", {}, title, legend), host);
  let branches = [];
  let plot = null;
  const draw = () => {
    plot?.destroy();
    plot = null;
    if (!branches.length || host.clientWidth < 40) return;
    const width = Math.max(...branches.flatMap(({ compression }) => compression)) / MM;
    plot = new uPlot(options(host, branches), [[0, width], [null, null]], host);
  };
  new ResizeObserver(draw).observe(host);
  onRepaint(draw);
  const show = (next) => {
    branches = next;
    element.hidden = branches.length === 0;
    legend.replaceChildren(...legendItems(branches));
    host.setAttribute("aria-label", described(branches));
    draw();
  };
  return { element, show };
}

function options(host, branches) {
  const colors = palette();
  const every = (name) => branches.flatMap((branch) => branch[name]);
  const range = (values) => {
    const [low, high] = [Math.min(...values), Math.max(...values)];
    const air = 0.04 * (high - low);
    return [low - air, high + air];
  };
  const axis = { stroke: colors.muted, font: LETTERS, grid: { stroke: colors.line, width: 1 }, ticks: { show: false } };
  const label = (unit) => (_, ticks) => ticks.map((tick, i) => format(tick, 4) + (i === ticks.length - 1 ? ` ${unit}` : ""));
  return {
    width: host.clientWidth,
    height: host.clientHeight,
    padding: [8, 24, 0, 0],
    legend: { show: false },
    cursor: { show: false },
    scales: {
      x: { time: false, range: () => range(every("compression").map((one) => one / MM)) },
      y: { range: () => range([...every("force"), ...every("fit")]) },
    },
    axes: [{ ...axis, size: 24, gap: 3, values: label("mm") }, { ...axis, size: 58, gap: 4, values: label("N") }],
    series: [{}, { show: false }],
    hooks: { draw: [(plot) => branches.forEach((branch, i) => drawBranch(plot, branch, colorOf(colors, i)))] },
  };
}

/** Draw the points of a branch as squares, and its fit as a line. */
function drawBranch(plot, { compression, force, fit }, color) {
  const { ctx } = plot;
  const size = 4 * devicePixelRatio;
  const x = (one) => plot.valToPos(one / MM, "x", true);
  const y = (one) => plot.valToPos(one, "y", true);
  ctx.save();
  ctx.fillStyle = color;
  ctx.globalAlpha = 0.35;
  force.forEach((one, i) => ctx.fillRect(x(compression[i]) - size / 2, y(one) - size / 2, size, size));
  ctx.globalAlpha = 1;
  ctx.strokeStyle = color;
  ctx.lineWidth = 2 * devicePixelRatio;
  ctx.beginPath();
  fit.forEach((one, i) => ctx[i ? "lineTo" : "moveTo"](x(compression[i]), y(one)));
  ctx.stroke();
  ctx.restore();
}

function legendItems(branches) {
  const colors = palette();
  return branches.map(({ label }, i) => {
    const swatch = h("span", { class: "swatch", "aria-hidden": "true" });
    swatch.style.setProperty("--ball", colorOf(colors, i));
    return h("li", {}, swatch, t("{name}: points, and the fitted line", { name: translated(label) }));
  });
}

/** Return the plot in words. */
function described(branches) {
  const told = branches.map(({ label, compression, force }) => {
    const { unit, size } = shownUnit("m");
    const deepest = format(Math.max(...compression) / size, 3);
    return t("{name}: {points} points, up to {most} N at {deepest} {unit}", { name: translated(label), points: force.length, most: format(Math.max(...force), 3), deepest, unit });
  });
  return `${t("Force over compression")}. ${told.join("; ")}.`;
}
