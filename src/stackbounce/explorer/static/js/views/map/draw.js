/** Draws a map on a canvas: the field, its lines of equal value, the sides, the colours' key. */

import { clipped } from "../../plots/chart.js";
import { MANY, colorAt, css, isLight } from "../../plots/colors.js";
import { contour, labelPlace } from "../../plots/contours.js";
import { fitting, marks, ticks } from "../drawing/sides.js";
import { LETTERS } from "../../plots/palette.js";
import { format, pretty } from "../../words/words.js";

const KEY = { top: 4, height: 12 }; // of the colours
const LABEL_ROOM = 26; // px around the label of a line

/** Return where the field lies in a canvas of this size, in px. */
function frameOf(width, height) {
  const [left, right, top, bottom] = [58, 14, 48, 44];
  return { left, top, width: Math.max(width - left - right, 20), height: Math.max(height - top - bottom, 20) };
}

/** Return a canvas's context, cleared and in CSS px, sized to what it fills. */
function prepared(canvas) {
  const { clientWidth: width, clientHeight: height } = canvas;
  const ratio = devicePixelRatio || 1;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const ctx = canvas.getContext("2d");
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.font = LETTERS;
  return { ctx, width, height };
}

/** Draw a map with the colours of the page; returns where its field lies. */
export function drawMap(canvas, answer, sides, scale, colors) {
  const { ctx, width, height } = prepared(canvas);
  const frame = frameOf(width, height);
  drawHatch(ctx, frame, colors);
  drawField(ctx, frame, answer.values, scale);
  if (scale.kind === "range") drawLevels(ctx, frame, answer.values, scale);
  ctx.strokeStyle = colors.muted;
  ctx.lineWidth = 1;
  ctx.strokeRect(frame.left - 0.5, frame.top - 0.5, frame.width + 1, frame.height + 1);
  ctx.fillStyle = colors.text;
  drawBottom(ctx, frame, sides.x, answer.x);
  drawLeft(ctx, frame, sides.y, answer.y);
  drawKey(ctx, frame, scale, answer.unit);
  return frame;
}

/** Draw hatching below the field; it shows through where a run did not finish. */
function drawHatch(ctx, frame, colors) {
  const { left, top, width, height } = frame;
  let lines = "";
  for (let x = -height; x < width; x += 8) lines += `M${left + x} ${top + height}l${height} ${-height}`;
  clipped({ ctx, bbox: frame }, () => {
    ctx.strokeStyle = colors.muted;
    ctx.globalAlpha = 0.5;
    ctx.stroke(new Path2D(lines));
  });
}

function drawField(ctx, { left, top, width, height }, values, scale) {
  const [rows, columns] = [values.length, values[0].length];
  const image = new ImageData(columns, rows);
  for (let row = 0; row < rows; row += 1) {
    for (let column = 0; column < columns; column += 1) {
      const value = values[row][column];
      if (value === null) continue;
      const [red, green, blue] = scale.color(value);
      const at = 4 * ((rows - 1 - row) * columns + column);
      image.data[at] = red;
      image.data[at + 1] = green;
      image.data[at + 2] = blue;
      image.data[at + 3] = 255;
    }
  }
  const field = document.createElement("canvas");
  [field.width, field.height] = [columns, rows];
  field.getContext("2d").putImageData(image, 0, 0);
  ctx.imageSmoothingEnabled = scale.kind === "range";
  // The first and the last value stand on the border itself: half a pixel of the field lies outside.
  ctx.drawImage(field, 0.5, 0.5, columns - 1, rows - 1, left, top, width, height);
}

function drawLevels(ctx, frame, values, scale) {
  const [rows, columns] = [values.length, values[0].length];
  const toX = (column) => frame.left + (column / (columns - 1)) * frame.width;
  const toY = (row) => frame.top + (1 - row / (rows - 1)) * frame.height;
  const taken = [];
  for (const { value: level } of ticks(scale.low, scale.high, false, 10)) {
    const pieces = contour(values, level).map(([a, b, c, d]) => [toX(a), toY(b), toX(c), toY(d)]);
    if (pieces.length === 0) continue;
    const light = isLight(scale.color(level));
    ctx.strokeStyle = light ? "rgb(0 0 0 / 55%)" : "rgb(255 255 255 / 65%)";
    ctx.lineWidth = 1;
    ctx.stroke(new Path2D(pieces.map(([x0, y0, x1, y1]) => `M${x0} ${y0}L${x1} ${y1}`).join("")));
    const inside = pieces.map(([a, b, c, d]) => [a - frame.left, b - frame.top, c - frame.left, d - frame.top]);
    const place = labelPlace(inside, taken, frame, LABEL_ROOM);
    if (!place) continue;
    taken.push(place);
    drawLabel(ctx, format(level, 3), frame.left + place[0], frame.top + place[1], scale.color(level), light);
  }
}

function drawLabel(ctx, text, x, y, color, light) {
  ctx.textAlign = "center";
  ctx.textBaseline = "middle";
  ctx.lineWidth = 4;
  ctx.lineJoin = "round";
  ctx.strokeStyle = css(color);
  ctx.strokeText(text, x, y);
  ctx.fillStyle = light ? "#000" : "#fff";
  ctx.fillText(text, x, y);
}

function drawBottom(ctx, { left, top, width, height }, side, axis) {
  const { title, ticks: found } = marks(side, axis, Math.max(Math.floor(width / 70), 2));
  const bottom = top + height;
  ctx.textAlign = "center";
  ctx.textBaseline = "top";
  for (const { part, text } of found) {
    const x = left + part * width;
    ctx.fillRect(x - 0.5, bottom, 1, text === null ? 3 : 6);
    if (text !== null) ctx.fillText(text, x, bottom + 8);
  }
  ctx.fillText(fitting(ctx, title, width + 40), left + width / 2, bottom + 26);
}

function drawLeft(ctx, { left, top, width, height }, side, axis) {
  const { title, ticks: found } = marks(side, axis, Math.max(Math.floor(height / 45), 2));
  ctx.textAlign = "right";
  ctx.textBaseline = "middle";
  for (const { part, text } of found) {
    const y = top + (1 - part) * height;
    const long = text === null ? 3 : 6;
    ctx.fillRect(left - long, y - 0.5, long, 1);
    if (text !== null) ctx.fillText(text, left - 9, y);
  }
  ctx.save();
  ctx.translate(10, top + height / 2);
  ctx.rotate(-Math.PI / 2);
  ctx.textAlign = "center";
  ctx.fillText(fitting(ctx, title, height + 20), 0, 0);
  ctx.restore();
}

function drawKey(ctx, { left, width }, scale, unit) {
  const { top, height } = KEY;
  ctx.textAlign = "center";
  ctx.textBaseline = "top";
  if (scale.kind === "counts") {
    const wide = width / Math.max(scale.counts.length, 1);
    scale.counts.forEach((count, i) => {
      const [x, text] = [left + i * wide, ctx.fillStyle];
      ctx.fillStyle = css(scale.color(count));
      ctx.fillRect(x, top, wide - 1, height);
      ctx.fillStyle = text;
      ctx.fillText(count < 0 ? "∞" : `${count}${count === MANY ? "+" : ""}`, x + wide / 2, top + height + 5);
    });
    return;
  }
  const ramp = ctx.createLinearGradient(left, 0, left + width, 0);
  for (let i = 0; i <= 16; i += 1) ramp.addColorStop(i / 16, css(colorAt(i / 16)));
  const text = ctx.fillStyle;
  ctx.fillStyle = ramp;
  ctx.fillRect(left, top, width, height);
  ctx.fillStyle = text;
  const named = pretty(unit);
  const found = ticks(scale.low, scale.high, false, Math.max(Math.floor(width / 60), 3));
  found.forEach(({ value }, i) => {
    const x = left + ((value - scale.low) / (scale.high - scale.low)) * width;
    ctx.fillRect(x - 0.5, top + height, 1, 4);
    ctx.fillText(`${format(value, 4)}${named && i === found.length - 1 ? ` ${named}` : ""}`, x, top + height + 6);
  });
}

/** Draw what lies on top: the present drop, and where the pointer or the keyboard is. */
export function drawMarks(canvas, present, pointed, colors) {
  const { ctx, width, height } = prepared(canvas);
  const frame = frameOf(width, height);
  const at = ([x, y]) => [frame.left + x * frame.width, frame.top + (1 - y) * frame.height];
  if (pointed) {
    const [x, y] = at(pointed);
    drawTwice(ctx, `M${x} ${frame.top}v${frame.height}M${frame.left} ${y}h${frame.width}`, [colors.paper, 3], [colors.text, 1]);
  }
  if (!present) return;
  const [x, y] = at(present);
  ctx.lineCap = "round";
  drawTwice(ctx, `M${x - 6} ${y - 6}l12 12M${x - 6} ${y + 6}l12 -12`, ["#000", 5], ["#fff", 2.5]);
}

/** Draw lines with a wide pen and over it with a thin one, so that they are seen on all colours. */
function drawTwice(ctx, lines, ...pens) {
  for (const [color, width] of pens) {
    ctx.strokeStyle = color;
    ctx.lineWidth = width;
    ctx.stroke(new Path2D(lines));
  }
}
