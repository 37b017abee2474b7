/** Draws a line as SVG, which is also the picture that is saved: axes, curves, and names at their ends. */

import { s } from "../../dom.js";
import { extentOf } from "../../extent.js";
import { t, translated } from "../../words/language.js";
import { nameOf } from "./in_words.js";
import { fitting, marks, sideOf, ticks } from "../drawing/sides.js";
import { colorOf, LETTERS, SMALL } from "../../plots/palette.js";
import { clean, format, pretty, shortened } from "../../words/words.js";

const FONT = "system-ui, sans-serif";
const WIDE = 560; // px from which names stand at the ends of the curves
const ROW = 16; // px of a name
const LONGEST = 18; // letters of a name
const TEXTBOOK = t("textbook");
const NOISE = 1e-9; // of a value: rounding
const APART = 55; // px between two marks of the values, about

const pen = document.createElement("canvas").getContext("2d");

/**
 * Return `{svg, frame, y}`: the drawing, where its field lies in px, and the scale of its values.
 * @param {object} answer what was computed @param {object} size `{width, height}` @param {object} colors by name
 * @param {object[]} measured `{value, error}` of each ball; empty for none
 */
export function drawLine(answer, { width, height }, colors, measured) {
  pen.font = LETTERS;
  const names = listNames(answer, colors);
  const room = Math.max(0, ...names.map(({ text }) => pen.measureText(text).width));
  const beside = width >= WIDE;
  const rows = beside ? [] : rowsOf(onlyOneTextbook(names, colors), width - 20);
  const [left, right, top, bottom] = [52, beside ? room + 24 : 16, beside ? 14 : 12 + ROW * rows.length, 46];
  const frame = { left, top, width: Math.max(width - left - right, 20), height: Math.max(height - top - bottom, 20) };
  const most = Math.max(Math.floor(frame.height / APART), 2);
  const y = scaleOf(answer, measured, most);
  const place = {
    x: (part) => frame.left + part * frame.width,
    y: (value) => frame.top + (1 - y.part(value)) * frame.height,
  };
  const svg = s(
    "svg",
    { width, height, viewBox: `0 0 ${width} ${height}`, "font-size": SMALL, "font-family": FONT, fill: colors.text },
    drawAcross(answer, frame, place, colors),
    drawUp(answer, ticks(y.low, y.high, false, most), frame, place, colors),
    drawMeasured(answer, measured, frame, place, colors),
    drawCurves(answer, place, colors),
    beside ? drawNames(names, frame, place) : drawRows(rows),
  );
  return { svg, frame, y };
}

/** Return the scale of the values: from 0 where they lie near it, to a round number. */
function scaleOf({ curves, show }, measured, most) {
  const all = curves.flatMap(({ values, textbook }) => [...values, ...(textbook?.values ?? [])]);
  const known = all.filter((value) => isDrawn(show, value));
  if (show === "rebound_ratio") for (const { value, error } of measured) known.push(value - error, value + error);
  let [low, high] = extentOf(known);
  if (!known.length || (show === "energy_retained" && high < 1 + NOISE)) [low, high] = [0, 1];
  if (low > 0 && low < 0.6 * high) low = 0;
  if (high < 0 && high > 0.6 * low) high = 0;
  const size = Math.max(Math.abs(low), Math.abs(high));
  if (high - low <= NOISE * size) [low, high] = [Math.min(2 * low, 0), Math.max(2 * high, 0) || 1];
  const found = ticks(low, high, false, most).map(({ value }) => value);
  const step = clean(found[1] - found[0]) || clean((high - low) / 2);
  const ends = { low: clean(Math.floor(low / step + 1e-9) * step), high: clean(Math.ceil(high / step - 1e-9) * step) };
  return { ...sideOf({ ...ends, log: false }), ...ends };
}

function drawAcross(answer, frame, place, colors) {
  const bottom = frame.top + frame.height;
  const { title, ticks: found } = marks(answer.x, { ...answer.x, label: translated(answer.x.label) }, Math.max(Math.floor(frame.width / 80), 2));
  const lines = found.flatMap(({ part, text }) => [
    text === null ? rule(place.x(part), bottom, place.x(part), bottom + 3, colors.muted) : rule(place.x(part), frame.top, place.x(part), bottom + 5, colors.line),
    text === null ? null : s("text", { x: place.x(part), y: bottom + 19, "text-anchor": "middle", text }),
  ]);
  const named = fitting(pen, title, frame.width + 40);
  return [...lines.filter(Boolean), s("text", { x: frame.left + frame.width / 2, y: bottom + 38, "text-anchor": "middle", text: named })];
}

function drawUp({ show, unit }, all, frame, place, colors) {
  const found = all.filter(({ value }) => show !== "collisions" || Number.isInteger(value));
  const scale = show === "energy_retained" ? 100 : 1;
  const ending = show === "energy_retained" ? " %" : unit ? ` ${pretty(unit)}` : "";
  return found.flatMap(({ value }, i) => [
    rule(frame.left, place.y(value), frame.left + frame.width, place.y(value), value === 0 ? colors.muted : colors.line),
    s("text", {
      x: frame.left - 8,
      y: place.y(value),
      dy: 4,
      "text-anchor": "end",
      text: `${format(clean(value * scale), 4)}${i === found.length - 1 ? ending : ""}`,
    }),
  ]);
}

function rule(x1, y1, x2, y2, stroke) {
  return s("line", { x1: x1.toFixed(1), y1: y1.toFixed(1), x2: x2.toFixed(1), y2: y2.toFixed(1), stroke });
}

/** Draw the measured speeds as bands, for they were measured at one drop and at no place of the line. */
function drawMeasured({ show }, measured, frame, place, colors) {
  if (show !== "rebound_ratio") return [];
  return measured.flatMap(({ value, error }, ball) => {
    const [top, bottom] = [place.y(value + error), place.y(value - error)];
    const color = colorOf(colors, ball);
    const text = t("measured {what}", { what: `${format(value, 3)} ± ${format(error, 2)}` });
    const band = { x: frame.left, width: frame.width, y: top.toFixed(1), height: Math.max(bottom - top, 2).toFixed(1), fill: color, opacity: 0.22 };
    const halo = { stroke: colors.card, "stroke-width": 3, "paint-order": "stroke" };
    const written = s("text", { x: frame.left + 8, y: (top - 5).toFixed(1), fill: color, ...halo, text });
    return [s("rect", { class: "line-measured", ...band }), written];
  });
}

function drawCurves(answer, place, colors) {
  const side = sideOf(answer.x);
  const parts = answer.x.values.map((value) => side.part(value));
  const above = answer.show === "collisions" ? answer.curves.length - 1 : 0; // counts that are the same lie on each other
  const drawn = (curve, index, dashed) => {
    const stroke = colorOfCurve(colors, index);
    const wide = 2.2 + 2.4 * Math.max(above - index, 0);
    const look = dashed ? { "stroke-dasharray": "5 4", "stroke-width": 1.4 } : { "stroke-width": wide, "stroke-linejoin": "round" };
    const { d, joins } = pathOf(answer, curve, parts, place);
    const jump = joins && s("path", { d: joins, fill: "none", stroke, "stroke-width": 1, "stroke-dasharray": "1 3" });
    return [jump, s("path", { class: dashed ? "line-textbook" : "line-curve", "data-curve": index ?? "all", d, fill: "none", stroke, ...look })];
  };
  const textbook = answer.curves.flatMap(({ index, textbook }) => (textbook ? drawn(textbook, index, true) : []));
  return [...textbook, ...answer.curves.flatMap((curve) => drawn(curve, curve.index, false))].filter(Boolean);
}

function colorOfCurve(colors, index) {
  return index === null ? colors.text : colorOf(colors, index);
}

/** Return the path of a curve, which is lifted at gaps and jumps, and what joins the ends of jumps. */
function pathOf({ show }, { values, jumps }, parts, place) {
  let [d, joins, down] = ["", "", false];
  const lifted = new Set(jumps);
  values.forEach((value, i) => {
    const known = isDrawn(show, value);
    if (known) {
      const [x, y] = [place.x(parts[i]).toFixed(2), place.y(value).toFixed(2)];
      d += `${down ? "L" : "M"}${x} ${y}`;
      if (lifted.has(i - 1)) joins += `M${x} ${place.y(values[i - 1]).toFixed(2)}L${x} ${y}`;
    }
    down = known && !lifted.has(i);
  });
  return { d, joins };
}

/** Return the names of the curves, `{text, value, color, dashed}`, at the values of their ends. */
function listNames(answer, colors) {
  return answer.curves.flatMap((curve) => {
    const color = colorOfCurve(colors, curve.index);
    const name = shortened(nameOf(answer, curve), LONGEST);
    const own = { text: name, value: lastOf(answer.show, curve.values), color, dashed: false };
    if (!curve.textbook) return [own];
    return [own, { text: TEXTBOOK, value: lastOf(answer.show, curve.textbook.values), color, dashed: true }];
  });
}

function lastOf(show, values) {
  return values.findLast((value) => isDrawn(show, value)) ?? 0;
}

/** Return whether a value has a place: a drop that did not end has none, nor have endless collisions, -1. */
function isDrawn(show, value) {
  return value !== null && (show !== "collisions" || value >= 0);
}

/** Write the names beside the ends of their curves, apart from each other. */
function drawNames(names, frame, place) {
  const [top, bottom] = [frame.top + 6, frame.top + frame.height];
  const ends = names.map((name) => ({ ...name, end: place.y(name.value) })).sort((a, b) => a.end - b.end || a.dashed - b.dashed);
  let least = top;
  for (const name of ends) {
    name.y = Math.max(name.end, least);
    least = name.y + ROW;
  }
  let most = bottom;
  for (const name of ends.reverse()) {
    name.y = Math.min(name.y, most);
    most = name.y - ROW;
  }
  const x = frame.left + frame.width + 8;
  return ends.map(({ text, color, dashed, y }) =>
    s("text", { class: "line-name", x, y: y.toFixed(1), dy: 4, fill: color, "font-weight": dashed ? 400 : 600, text }),
  );
}

/** Return the names with one for all that the textbook says: rows have no room for more. */
function onlyOneTextbook(names, colors) {
  const theirs = names.some(({ dashed }) => dashed) ? [{ text: TEXTBOOK, color: colors.muted, dashed: true }] : [];
  return [...names.filter(({ dashed }) => !dashed), ...theirs];
}

/** Return the names in rows as wide as there is room: `{x, y}` and the name. */
function rowsOf(names, width) {
  const rows = [[]];
  let x = 0;
  for (const name of names) {
    const wide = pen.measureText(name.text).width + 40;
    if (x + wide > width && rows.at(-1).length) {
      rows.push([]);
      x = 0;
    }
    rows.at(-1).push({ ...name, x });
    x += wide;
  }
  return rows;
}

function drawRows(rows) {
  return rows.flatMap((row, i) =>
    row.flatMap(({ text, color, dashed, x }) => [
      s("line", { x1: 10 + x, x2: 28 + x, y1: 8 + ROW * i, y2: 8 + ROW * i, stroke: color, "stroke-width": dashed ? 1.4 : 2.2, "stroke-dasharray": dashed && "5 4" }),
      s("text", { class: "line-name", x: 32 + x, y: 12 + ROW * i, fill: color, text }),
    ]),
  );
}

/** Draw what lies on top into a group: the present drop, and where the pointer or the keyboard is. */
export function drawLineMarks(group, drawing, spots, colors) {
  const { frame, y } = drawing;
  const bottom = frame.top + frame.height;
  group.replaceChildren(
    ...spots.flatMap(({ part, values, present }) => {
      const x = frame.left + part * frame.width;
      const line = s("line", { x1: x, x2: x, y1: frame.top, y2: bottom, stroke: present ? colors.muted : colors.text, "stroke-dasharray": present && "2 4" });
      const dots = values
        .filter(({ value }) => value !== null && y.part(value) >= 0 && y.part(value) <= 1)
        .map(({ value, index }) =>
          s("circle", {
            cx: x,
            cy: frame.top + (1 - y.part(value)) * frame.height,
            r: present ? 5.5 : 4,
            fill: present ? colorOfCurve(colors, index) : colors.card,
            stroke: present ? colors.card : colorOfCurve(colors, index),
            "stroke-width": 2,
          }),
        );
      return [line, ...dots];
    }),
  );
}
