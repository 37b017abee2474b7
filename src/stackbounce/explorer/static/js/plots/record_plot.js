/** The plot of a record over the simulated drop: dots over lines, with a slider for the clock. */

import uPlot from "../../vendor/uplot/uPlot.esm.js";
import { h, write } from "../dom.js";
import { t } from "../words/language.js";
import { colorOf, LETTERS, onRepaint, palette } from "./palette.js";
import { format, shownUnit } from "../words/units.js";

const SLIDER = 400; // steps to either side

/** Return `{element, show(content)}`; content is {curves, simulated, window, names, shift, reach, move, align}. */
export function recordPlot() {
  const host = h("div", { class: "record-canvas", role: "img" });
  const legend = h("ul", { class: "legend" });
  const title = h("h3");
  const slider = h("input", { type: "range", id: "record-shift", min: -SLIDER, max: SLIDER, step: 1 });
  const moved = h("output", { for: "record-shift", class: "record-moved" });
  const best = h("button", { type: "button", text: t("Lay on") });
  const whole = h("input", { type: "checkbox" });
  const clock = h(
    "div",
    { class: "record-clock" },
    h("label", { for: "record-shift", text: t("Record’s clock") }),
    slider,
    moved,
    best,
    h("label", { class: "check" }, whole, t("whole record")),
  );
  const element = h("figure", { class: "record" }, h("figcaption", {}, title, legend), host, clock);
  let content = null;
  let plot = null;

  const draw = () => {
    plot?.destroy();
    plot = null;
    if (!content || host.clientWidth < 40) return;
    plot = new uPlot(options(host, content, whole.checked), data(content), host);
    host.setAttribute("aria-label", described(content));
  };
  const told = (shift) => `${shift > 0 ? "+" : ""}${format(shift * 1e3, 3)} ms`;
  const place = () => {
    const { shift, reach } = content;
    slider.value = Math.round((shift / reach) * SLIDER);
    slider.setAttribute("aria-valuetext", told(shift));
    write(moved, told(shift));
  };
  slider.addEventListener("input", () => content.move((Number(slider.value) / SLIDER) * content.reach, false));
  slider.addEventListener("change", () => content.move((Number(slider.value) / SLIDER) * content.reach, true));
  best.addEventListener("click", () => content.align());
  whole.addEventListener("change", draw);
  new ResizeObserver(draw).observe(host);
  onRepaint(draw);

  const show = (next) => {
    const other = content?.record !== next.record;
    content = next;
    if (other) whole.checked = next.whole;
    clock.hidden = !next.simulated;
    write(title, headings[next.curves[0].what] ?? t("Record"));
    legend.replaceChildren(...legendItems(next));
    if (next.simulated) place();
    draw();
  };
  return { element, show };
}

const headings = { force: t("Force, measured and simulated"), position: t("Position, measured and simulated") };

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

function options(host, content, whole) {
  const { curves, simulated } = content;
  const colors = palette();
  const scale = scales(content, whole);
  const color = ({ index }) => colorOf(colors, index);
  const axis = {
    stroke: colors.muted,
    font: LETTERS,
    grid: { stroke: colors.line, width: 1 },
    ticks: { show: false },
  };
  const label = (size, unit) => (_, ticks) =>
    ticks.map((tick, i) => format(tick / size, 4) + (unit && i === ticks.length - 1 ? ` ${unit}` : ""));
  return {
    width: host.clientWidth,
    height: host.clientHeight,
    padding: [8, 14, 0, 0],
    legend: { show: false },
    cursor: { show: false },
    scales: {
      x: { time: false, range: () => [scale.begin, scale.end] },
      y: { range: () => [scale.low, scale.high] },
    },
    axes: [
      { ...axis, size: 24, gap: 3, values: label(scale.time, scale.timeUnit) },
      { ...axis, size: 58, gap: 4, values: label(scale.value.size, scale.value.unit) },
    ],
    series: [
      {},
      ...(simulated ?? curves).map((line) => ({
        stroke: color(line),
        width: simulated ? 2 : 1,
        spanGaps: true,
        points: { show: false },
        pxAlign: 0,
      })),
    ],
    hooks: simulated ? { drawAxes: [(plot) => drawDots(plot, curves, colors)] } : {},
  };
}

/** Return the range of what lies in the window, with a little air. */
function span(all, { begin, end }) {
  let [low, high] = [Infinity, -Infinity];
  for (const { time, values } of all) {
    values.forEach((value, i) => {
      if (value === null || time[i] < begin || time[i] > end) return;
      low = Math.min(low, value);
      high = Math.max(high, value);
    });
  }
  if (!(high > low)) return [0, 1];
  const air = 0.06 * (high - low);
  return [low - air, high + air];
}

function drawDots(plot, curves, colors) {
  const { ctx } = plot;
  const { left, top, width, height } = plot.bbox;
  const size = 4 * devicePixelRatio;
  ctx.save();
  ctx.beginPath();
  ctx.rect(left, top, width, height);
  ctx.clip();
  ctx.globalAlpha = 0.6;
  for (const { time, values } of curves) {
    ctx.fillStyle = colors.text;
    values.forEach((value, i) => {
      if (value === null) return;
      ctx.fillRect(plot.valToPos(time[i], "x", true) - size / 2, plot.valToPos(value, "y", true) - size / 2, size, size);
    });
  }
  ctx.restore();
}

function legendItems({ curves, simulated, names }) {
  const colors = palette();
  const item = (kind, color, text) => {
    const swatch = h("span", { class: `swatch ${kind}`, "aria-hidden": "true" });
    swatch.style.setProperty("--ball", color);
    return h("li", {}, swatch, text);
  };
  const lines = curves.map(({ index }, i) => item("", colorOf(colors, index), names[i]));
  return simulated ? [item("measured", colors.text, t("measured")), ...lines] : lines;
}

/** Return the plot in words. */
function described({ curves, simulated, names }) {
  const peak = ({ values }) => values.reduce((most, value) => Math.max(most, value ?? -Infinity), -Infinity);
  return curves
    .map((one, i) => {
      const { unit, size } = shownUnit(one.unit, Math.abs(peak(one)) > 0.3);
      const values = { name: names[i], points: one.values.length, most: format(peak(one) / size, 3), unit };
      const own = t("{name}: {points} points, at most {most} {unit}", values);
      return simulated ? t("{own}; simulated at most {most} {unit}", { own, unit, most: format(peak(simulated[i]) / size, 3) }) : own;
    })
    .join(". ");
}
