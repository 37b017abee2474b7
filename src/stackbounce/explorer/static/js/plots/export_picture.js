/** The curves of a drop as a picture that needs no server, SVG or PNG. */

import { panels } from "./curves.js";
import { s } from "../dom.js";
import { extentOf } from "../extent.js";
import { t } from "../words/language.js";
import { ticks } from "../views/drawing/sides.js";
import { colorOf, paperPalette } from "./palette.js";
import { ballName, format, setUp } from "../words/words.js";

const WIDTH = 720;

const PANEL = { left: 64, width: 630, height: 170, step: 226, top: 44 };
const SCALE = 2; // px of a PNG for each unit of the SVG

/** Return a Blob with the picture of a result: kind is svg or png. */
export function pictureOf(kind, result, until) {
  const found = panels(result, until !== null);
  const height = PANEL.top + found.length * PANEL.step;
  const colors = paperPalette();
  const paint = (index) => (index === null ? colors.text : colorOf(colors, index));
  const title = result.drop.balls.map((_, ball) => ballName(result.drop, ball)).reverse().reduce((upper, lower) => t("{upper} on {lower}", { upper, lower }));
  const svg = s(
    "svg",
    { viewBox: `0 0 ${WIDTH} ${height}`, width: WIDTH, height, "font-family": "sans-serif", "font-size": 11 },
    s("desc", { text: setUp(result.drop) }),
    s("text", { x: PANEL.left, y: 24, "font-size": 15, text: title }),
    found.map((panel, i) => drawPanel(panel, PANEL.top + i * PANEL.step, paint)),
  );
  return fileOf(kind, svg, height);
}

/** Return a Blob of a drawing, on white and without characters that XML has not: kind is svg or png; it is `WIDTH` wide. */
function fileOf(kind, svg, height) {
  svg.prepend(s("rect", { width: WIDTH, height, fill: "white" }));
  const text = new XMLSerializer().serializeToString(svg).replace(/[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]|\p{Cs}/gu, "\ufffd");
  const blob = new Blob([text], { type: "image/svg+xml" });
  return kind === "svg" ? blob : rasterised(blob, height);
}

function drawPanel(panel, top, paint) {
  const { times, lines, stems = [], title, unit, timeUnit } = panel;
  const [low, high] = rangeOf(panel);
  const x = (time) => (PANEL.left + ((time - times[0]) / (times.at(-1) - times[0])) * PANEL.width).toFixed(2);
  const y = (value) => (top + (1 - (value - low) / (high - low)) * PANEL.height).toFixed(2);
  const [bottom, right] = [top + PANEL.height, PANEL.left + PANEL.width];
  const marks = ticks(low, high, false, 5).flatMap(({ value }) => [
    s("line", { x1: PANEL.left, x2: right, y1: y(value), y2: y(value), stroke: "#ddd" }),
    s("text", { x: PANEL.left - 6, y: y(value), dy: 4, "text-anchor": "end", text: format(value, 4) }),
  ]);
  const clock = ticks(times[0], times.at(-1), false, 8).map(({ value }) => s("text", { x: x(value), y: bottom + 16, "text-anchor": "middle", text: format(value, 4) }));
  return [
    ...marks,
    s("rect", { x: PANEL.left, y: top, width: PANEL.width, height: PANEL.height, fill: "none", stroke: "#888" }),
    ...clock,
    s("text", { x: right, y: bottom + 30, "text-anchor": "end", text: t("time in {unit}", { unit: timeUnit }) }),
    ...lines.filter(({ values }) => values).map((line) => curve(line, times, x, y, paint)),
    ...stems.map(({ index, time, impulse }) => s("line", { x1: x(time), x2: x(time), y1: y(0), y2: y(impulse), stroke: paint(index), "stroke-width": 3 })),
    s("text", { x: PANEL.left + 6, y: top - 6, "font-size": 12, text: `${title}, ${unit}` }),
    legend(lines, right, top - 6, paint),
  ];
}

function rangeOf({ lines, stems = [], floor = Infinity }) {
  const [low, high] = extentOf([floor, ...lines.flatMap(({ values }) => values ?? []), ...stems.map(({ impulse }) => impulse)]);
  if (!(high > low)) return Number.isFinite(low) ? [low - 1, low + 1] : [0, 1];
  const air = 0.06 * (high - low);
  return [low === floor ? low : low - air, high + air];
}

function curve({ index, values, dash }, times, x, y, paint) {
  const points = values.map((value, i) => (Number.isFinite(value) ? `${x(times[i])},${y(value)}` : "")).filter(Boolean);
  return s("polyline", { fill: "none", stroke: paint(index), "stroke-width": 1.6, "stroke-dasharray": dash?.join(" "), points: points.join(" ") });
}

function legend(lines, x, y, paint) {
  const names = [...lines].reverse().flatMap(({ label, index }) => ["   ", s("tspan", { fill: paint(index), text: label })]);
  return s("text", { x, y, "font-size": 12, "text-anchor": "end" }, names.slice(1));
}

/** Return an SVG as a PNG; it is `WIDTH` wide. */
async function rasterised(blob, height) {
  const url = URL.createObjectURL(blob);
  try {
    const image = new Image();
    image.src = url;
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: SCALE * WIDTH, height: SCALE * height });
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((done) => canvas.toBlob(done, "image/png"));
  } finally {
    URL.revokeObjectURL(url);
  }
}
