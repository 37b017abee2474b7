/** The curves of a drop as a picture, SVG or PNG, that needs no server. */

import { panels } from "./curves.js";
import { extentOf } from "../extent.js";
import { t } from "../words/language.js";
import { ticks } from "../views/drawing/axes.js";
import { colorOf, paperPalette } from "./palette.js";
import { ballName, format, setUp } from "../words/words.js";

/** Of all pictures that are saved. */
export const WIDTH = 720;

const PANEL = { left: 64, width: 630, height: 170, step: 226, top: 44 };
const SCALE = 2; // px of a PNG for each unit of the SVG
const FONT = "font-family='sans-serif'";

/** Return a Blob with the picture of a result: kind is svg or png. */
export async function pictureOf(kind, result, until) {
  const text = writeSvg(result, until !== null);
  const blob = new Blob([text], { type: "image/svg+xml" });
  return kind === "svg" ? blob : rasterised(blob, heightOf(3));
}

function heightOf(count) {
  return PANEL.top + count * PANEL.step;
}

function writeSvg(result, whole) {
  const found = panels(result, whole);
  const colors = paperPalette();
  const paint = (index) => (index === null ? colors.text : colorOf(colors, index));
  const parts = found.map((panel, i) => drawPanel(panel, PANEL.top + i * PANEL.step, paint));
  const title = result.drop.balls.map((_, ball) => ballName(result.drop, ball)).reverse().reduce((upper, lower) => t("{upper} on {lower}", { upper, lower }));
  return [
    `<?xml version="1.0" encoding="utf-8"?>`,
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${WIDTH} ${heightOf(found.length)}" width="${WIDTH}" height="${heightOf(found.length)}">`,
    `<desc>${escaped(setUp(result.drop))}</desc>`,
    `<rect width="100%" height="100%" fill="white"/>`,
    `<text x="${PANEL.left}" y="24" font-size="15" ${FONT}>${escaped(title)}</text>`,
    ...parts,
    "</svg>",
    "",
  ].join("\n");
}

/** Return a text without characters that XML has not. */
export function plain(text) {
  return text.replace(/[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]|\p{Cs}/gu, "\ufffd");
}

/** Return a text as it stands in XML. */
function escaped(text) {
  return plain(text).replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;").replaceAll('"', "&quot;");
}

function drawPanel(panel, top, paint) {
  const { times, lines, stems = [], title, unit, timeUnit } = panel;
  const [low, high] = rangeOf(panel);
  const x = (time) => (PANEL.left + ((time - times[0]) / (times.at(-1) - times[0])) * PANEL.width).toFixed(2);
  const y = (value) => (top + (1 - (value - low) / (high - low)) * PANEL.height).toFixed(2);
  const bottom = top + PANEL.height;
  const marks = ticks(low, high, false, 5).map(
    ({ value }) =>
      `<line x1="${PANEL.left}" x2="${PANEL.left + PANEL.width}" y1="${y(value)}" y2="${y(value)}" stroke="#ddd"/>` +
      `<text x="${PANEL.left - 6}" y="${y(value)}" dy="4" font-size="11" text-anchor="end" ${FONT}>${format(value, 4)}</text>`,
  );
  const clock = ticks(times[0], times.at(-1), false, 8).map(
    ({ value }) => `<text x="${x(value)}" y="${bottom + 16}" font-size="11" text-anchor="middle" ${FONT}>${format(value, 4)}</text>`,
  );
  const curves = lines.filter(({ values }) => values).map((line) => curve(line, times, x, y, paint));
  const blows = stems.map(
    ({ index, time, impulse }) =>
      `<line x1="${x(time)}" x2="${x(time)}" y1="${y(0)}" y2="${y(impulse)}" stroke="${paint(index)}" stroke-width="3"/>`,
  );
  return [
    ...marks,
    `<rect x="${PANEL.left}" y="${top}" width="${PANEL.width}" height="${PANEL.height}" fill="none" stroke="#888"/>`,
    ...clock,
    `<text x="${PANEL.left + PANEL.width}" y="${bottom + 30}" font-size="11" text-anchor="end" ${FONT}>${escaped(t("time in {unit}", { unit: timeUnit }))}</text>`,
    ...curves,
    ...blows,
    `<text x="${PANEL.left + 6}" y="${top - 6}" font-size="12" ${FONT}>${escaped(title)}, ${escaped(unit)}</text>`,
    legend(lines, top - 6, paint),
  ].join("\n");
}

function rangeOf({ lines, stems = [], floor = Infinity }) {
  const [low, high] = extentOf([floor, ...lines.flatMap(({ values }) => values ?? []), ...stems.map(({ impulse }) => impulse)]);
  if (!(high > low)) return Number.isFinite(low) ? [low - 1, low + 1] : [0, 1];
  const air = 0.06 * (high - low);
  return [low === floor ? low : low - air, high + air];
}

function curve({ index, values, dash }, times, x, y, paint) {
  const points = values.map((value, i) => (Number.isFinite(value) ? `${x(times[i])},${y(value)}` : "")).filter(Boolean);
  const dashed = dash ? ` stroke-dasharray="${dash.join(" ")}"` : "";
  return `<polyline fill="none" stroke="${paint(index)}" stroke-width="1.6"${dashed} points="${points.join(" ")}"/>`;
}

function legend(lines, y, paint) {
  const names = [...lines].reverse().map(({ label, index }) => `<tspan fill="${paint(index)}">${escaped(label)}</tspan>`);
  return `<text x="${PANEL.left + PANEL.width}" y="${y}" font-size="12" text-anchor="end" ${FONT}>${names.join("   ")}</text>`;
}

/** Return an SVG as a PNG; it is `WIDTH` wide. */
export async function rasterised(blob, height) {
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
