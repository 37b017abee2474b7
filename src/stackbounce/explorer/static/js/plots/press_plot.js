/** The plot of a press curve: force over compression, pressed in and let go, with the fitted lines. */

import uPlot from "../../vendor/uplot/uPlot.esm.js";
import { chartOptions, drawDots, legendItem, plotIn, ticksIn } from "./chart.js";
import { partsOf } from "../dom.js";
import { extentOf } from "../extent.js";
import { t, translated } from "../words/language.js";
import { colorOf, palette } from "./palette.js";
import { format, shownUnit } from "../words/words.js";

const MM = 1e-3; // m

/** Return what shows branches in the figure of `root`. */
export function pressPlot(root) {
  let branches = [];
  const { legend, host } = partsOf(root);
  const draw = plotIn(host, () => {
    if (!branches.length) return null;
    host.setAttribute("aria-label", described(branches));
    const width = Math.max(...branches.flatMap(({ compression }) => compression)) / MM;
    return new uPlot(options(host, branches), [[0, width], [null, null]], host);
  });
  return (next) => {
    branches = next;
    const colors = palette();
    const named = ({ label }) => t("{name}: points, and the fitted line", { name: translated(label) });
    legend.replaceChildren(...branches.map((branch, i) => legendItem(colorOf(colors, i), "", named(branch))));
    draw();
  };
}

function options({ clientWidth: width, clientHeight: height }, branches) {
  const colors = palette();
  const every = (name) => branches.flatMap((branch) => branch[name]);
  const range = (values) => {
    const [low, high] = extentOf(values);
    const air = 0.04 * (high - low);
    return [low - air, high + air];
  };
  return chartOptions(colors, {
    width,
    height,
    padding: [8, 24, 0, 0],
    x: () => range(every("compression").map((compression) => compression / MM)),
    y: () => range([...every("force"), ...every("fit")]),
    axes: [{ size: 24, gap: 3, values: ticksIn(1, "mm") }, { size: 58, gap: 4, values: ticksIn(1, "N") }],
    series: [{ show: false }],
    hooks: { draw: [(plot) => branches.forEach((branch, i) => drawBranch(plot, branch, colorOf(colors, i)))] },
  });
}

/** Draw the points of a branch as squares, and its fit as a line. */
function drawBranch(plot, { compression, force, fit }, color) {
  const { ctx } = plot;
  const across = compression.map((value) => value / MM);
  ctx.save();
  ctx.fillStyle = color;
  ctx.globalAlpha = 0.35;
  drawDots(plot, across, force, 4);
  ctx.globalAlpha = 1;
  ctx.strokeStyle = color;
  ctx.lineWidth = 2 * devicePixelRatio;
  ctx.beginPath();
  fit.forEach((value, i) => ctx.lineTo(plot.valToPos(across[i], "x", true), plot.valToPos(value, "y", true)));
  ctx.stroke();
  ctx.restore();
}

/** Return the plot in words. */
function described(branches) {
  const words = branches.map(({ label, compression, force }) => {
    const { unit, size } = shownUnit("m");
    const deepest = format(Math.max(...compression) / size, 3);
    return t("{name}: {points} points, up to {most} N at {deepest} {unit}", { name: translated(label), points: force.length, most: format(Math.max(...force), 3), deepest, unit });
  });
  return `${t("Force over compression")}. ${words.join("; ")}.`;
}
