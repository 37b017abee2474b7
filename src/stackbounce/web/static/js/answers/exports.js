/** A drop as texts: its data, its scenario, and lines of Python: as stackbounce/web/answers/exports.py. */

import { lawCode } from "../model/calibration.js";
import { repr, writeFloat } from "../model/errors.js";
import { known } from "../model/known.js";
import { readDrop } from "../model/schema.js";
import { checkUntil, chooseWindow, runDrop, sampleWithEnergy, spaced } from "./play.js";

const SAMPLES = 1001;

/** Return a drop as a text: csv, toml or python. */
export function exportText(kind, mapping, until_) {
  const drop = readDrop(mapping);
  const until = checkUntil(until_);
  return { csv: () => writeTable(drop, until), toml: () => writeToml(drop.toMapping()), python: () => writePython(drop, until) }[kind]();
}

/** Return positions, velocities, forces and energy over time, as CSV. */
function writeTable(drop, until) {
  const result = runDrop(drop, until);
  const times = spaced(...chooseWindow(result), SAMPLES);
  const { position, velocity, force, energy } = sampleWithEnergy(result, times);
  const columns = [["time (s)", times]];
  position.forEach((values, i) => columns.push([`position ${i} (m)`, values]));
  velocity.forEach((values, i) => columns.push([`velocity ${i} (m/s)`, values]));
  force.forEach((values, i) => columns.push([`force ${i} (N)`, values]));
  columns.push(["energy (J)", energy.total]);
  const rows = times.map((_, row) => columns.map(([, values]) => writeFloat(values[row])).join(","));
  return `${[columns.map(([name]) => name).join(","), ...rows].join("\n")}\n`;
}

/** Return a drop as a scenario file, which the command line reads. */
function writeToml(drop) {
  const lines = [];
  const tables = [];
  for (const [key, value] of Object.entries(drop)) {
    if (Array.isArray(value) && value.length && typeof value[0] === "object") {
      for (const table of value) {
        tables.push("", `[[${key}]]`, ...Object.entries(table).map(([name, one]) => `${name} = ${written(one)}`));
      }
    } else lines.push(`${key} = ${written(value)}`);
  }
  return `${[...lines, ...tables].join("\n")}\n`;
}

function written(value) {
  if (typeof value === "string") return JSON.stringify(value).replaceAll("\x7f", "\\u007f");
  return Array.isArray(value) ? `[${value.map(written).join(", ")}]` : writeFloat(value);
}

/** Return lines of Python that simulate a drop and draw it. */
function writePython(drop, until) {
  const { balls, contacts: _, ...rest } = drop.toMapping();
  const call = (ball) => `sb.Ball(${Object.entries(ball).map(([name, value]) => `${name}=${repr(value)}`).join(", ")})`;
  const contacts = drop.contacts.map((law) => (law === null ? "None" : `sb.${lawCode(law)}`));
  const stop = until === null ? "" : `, until=${writeFloat(until)}`;
  const lines = [
    `# Made by stackbounce ${known.stackbounce}`,
    "import stackbounce as sb",
    "from stackbounce import plots",
    "",
    "drop = sb.Drop(",
    `    balls=[\n        ${balls.map(call).join(",\n        ")},\n    ],`,
    `    contacts=[\n        ${contacts.join(",\n        ")},\n    ],`,
    ...Object.entries(rest).map(([key, value]) => `    ${key}=${repr(value)},`),
    ")",
    `result = sb.simulate(drop${stop})`,
    'print("rebound ratios:", result.rebound_ratios)',
    'plots.bounce(result).savefig("bounce.svg")',
  ];
  return `${lines.join("\n")}\n`;
}
