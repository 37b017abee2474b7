/** A line as a file: a table of its numbers, or its picture. */

import { WIDTH, fileOf } from "../../plots/export_picture.js";
import { drawLine } from "./draw.js";
import { paperPalette } from "../../plots/palette.js";

const HEIGHT = 440;

/** Return a Blob of a line: csv, svg or png. */
export function saved(kind, answer, measured) {
  if (kind === "csv") return new Blob([tableOf(answer)], { type: "text/csv; charset=utf-8" });
  return fileOf(kind, drawLine(answer, { width: WIDTH, height: HEIGHT }, paperPalette(), measured).svg, HEIGHT);
}

/** Return a line as CSV in SI units: what varies, and each curve. */
function tableOf({ x, curves, unit }) {
  const named = (label, of) => (of ? `${label} (${of})` : label);
  const columns = [[named(x.label, x.unit), x.values]];
  for (const { label, values, textbook } of curves) {
    columns.push([named(label, unit), values]);
    if (textbook) columns.push([named(`${label}, textbook`, unit), textbook.values]);
  }
  const head = columns.map(([name]) => `"${name.replaceAll('"', '""')}"`).join(",");
  const rows = x.values.map((_, i) => columns.map(([, values]) => values[i] ?? "").join(","));
  return `${[head, ...rows].join("\n")}\n`;
}
