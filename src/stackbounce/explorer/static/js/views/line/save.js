/** A line as a file: a table of its numbers, or its picture. */

import { s } from "../../dom.js";
import { WIDTH, plain, rasterised } from "../../plots/export_picture.js";
import { drawLine } from "./draw.js";
import { paperPalette } from "../../plots/palette.js";

const HEIGHT = 440;

/** Return a Blob of a line: csv, svg or png. */
export async function fileOf(kind, answer, measured) {
  if (kind === "csv") return new Blob([tableOf(answer)], { type: "text/csv; charset=utf-8" });
  const { svg } = drawLine(answer, { width: WIDTH, height: HEIGHT }, paperPalette(), measured);
  svg.prepend(s("rect", { width: WIDTH, height: HEIGHT, fill: "white" }));
  const blob = new Blob([plain(new XMLSerializer().serializeToString(svg))], { type: "image/svg+xml" });
  return kind === "svg" ? blob : rasterised(blob, HEIGHT);
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
