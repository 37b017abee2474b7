/** The plot of a record over the simulated drop: dots over lines. */

import uPlot from "../../vendor/uplot/uPlot.esm.js";
import { chartOptions, clipped, drawDots, legendItem, plotIn, ticksIn } from "./chart.js";
import { partsOf, write } from "../dom.js";
import { extentOf } from "../extent.js";
import { t } from "../words/language.js";
import { colorOf, palette } from "./palette.js";
import { format, shownUnit } from "../words/words.js";

/** Return what shows a content in the figure of `root`: {record, curves, simulated, window, names, whole}. */
export function recordPlot(root) {
  let content = null;
  const { title, legend, host, seen, whole } = partsOf(root);
  const draw = plotIn(host, () => {
    if (!content) return null;
    host.setAttribute("aria-label", described(content));
    return new uPlot(options(host, content, whole.checked), data(content), host);
  });
  whole.addEventListener("change", draw);

  return (next) => {
    const isOther = content?.record !== next.record;
    content = next;
    if (isOther) whole.checked = next.whole;
    seen.hidden = !next.simulated;
    write(title, HEADINGS[next.curves[0].what] ?? t("Record"));
    legend.replaceChildren(...legendItems(next));
    draw();
  };
}

const HEADINGS = { force: t("Force, measured and simulated"), position: t("Position, measured and simulated") };

function scales({ curves, simulated, window }, whole) {
  const [begin, end] = whole || !simulated ? ends(curves) : window;
  const { unit, size } = shownUnit("s", end - begin > 0.3);
  const [low, high] = span([...curves, ...(simulated ?? [])], { begin, end });
  const own = curves[0].unit === "1" ? "" : curves[0].unit;
  return { begin, end, low, high, time: size, timeUnit: unit, value: shownUnit(own, high - low > 0.3) };
}

/** Return when the first of curves begins and the last ends. */
function ends(curves) {
  const begin = Math.min(...curves.map(({ time }) => time[0]));
  const end = Math.max(...curves.map(({ time }) => time.at(-1)));
  return end > begin ? [begin, end] : [begin, begin + 1];
}

/** uPlot wants one list of times: that of all lines together, with gaps where a line has none. */
function data({ curves, simulated }) {
  const drawn = simulated ?? curves;
  return uPlot.join(drawn.map(({ time, values }) => [time, values]));
}

function options({ clientWidth: width, clientHeight: height }, content, whole) {
  const { curves, simulated } = content;
  const colors = palette();
  const scale = scales(content, whole);
  const lines = (simulated ?? curves).map(({ index }) => ({
    stroke: colorOf(colors, index),
    width: simulated ? 2 : 1,
    spanGaps: true,
    points: { show: false },
    pxAlign: 0,
  }));
  return chartOptions(colors, {
    width,
    height,
    padding: [8, 14, 0, 0],
    x: () => [scale.begin, scale.end],
    y: () => [scale.low, scale.high],
    axes: [
      { size: 24, gap: 3, values: ticksIn(scale.time, scale.timeUnit) },
      { size: 58, gap: 4, values: ticksIn(scale.value.size, scale.value.unit) },
    ],
    series: lines,
    hooks: simulated ? { drawAxes: [(plot) => drawRecord(plot, curves, colors)] } : {},
  });
}

/** Return the range of what lies in the window, with a little air. */
function span(curves, { begin, end }) {
  const isSeen = (time) => time >= begin && time <= end;
  const [low, high] = extentOf(curves.flatMap(({ time, values }) => values.filter((_, i) => isSeen(time[i]))));
  if (!(high > low)) return [0, 1];
  const air = 0.06 * (high - low);
  return [low - air, high + air];
}

function drawRecord(plot, curves, colors) {
  clipped(plot, (ctx) => {
    ctx.globalAlpha = 0.6;
    ctx.fillStyle = colors.text;
    for (const { time, values } of curves) drawDots(plot, time, values, 4);
  });
}

function legendItems({ curves, simulated, names }) {
  const colors = palette();
  const lines = curves.map(({ index }, i) => legendItem(colorOf(colors, index), "", names[i]));
  return simulated ? [legendItem(colors.text, "measured", t("measured")), ...lines] : lines;
}

/** Return the plot in words. */
function described({ curves, simulated, names }) {
  const peak = ({ values }) => extentOf(values)[1];
  return curves
    .map((curve, i) => {
      const { unit, size } = shownUnit(curve.unit, Math.abs(peak(curve)) > 0.3);
      const values = { name: names[i], points: curve.values.length, most: format(peak(curve) / size, 3), unit };
      const own = t("{name}: {points} points, at most {most} {unit}", values);
      return simulated ? t("{own}; simulated at most {most} {unit}", { own, unit, most: format(peak(simulated[i]) / size, 3) }) : own;
    })
    .join(". ");
}
