/** A drop as texts: its data, its scenario, and lines of Python. */

import { lawCode } from "../model/calibration.js";
import { aligned } from "../model/drop.js";
import { InvalidValue, between, repr, writeFloat } from "../model/errors.js";
import { known } from "../model/known.js";
import { dropAt, numbersOf, valueIn } from "../model/paths.js";
import { readDrop } from "../model/schema.js";
import { checkUntil, chooseWindow, runDrop, sampleWithEnergy, spaced } from "./play.js";

const SAMPLES = 1001;

/** Return a drop as a text, csv, toml or python; the last two have the errors of its numbers, by path. */
export function exportText(kind, mapping, until_, errors = {}) {
  const drop = readDrop(aligned(mapping));
  const until = checkUntil(until_);
  if (kind === "csv") return writeTable(drop, until);
  const pairs = addValues(drop, errors).filter(({ error }) => error > 0);
  const moved = mapping.balls.flatMap(({ offset }, ball) => (offset && until === null ? [`${ball}: ${writeFloat(offset)}`] : []));
  return kind === "toml" ? writeToml(withErrors(drop, pairs)) : writePython(drop, until, pairs, moved);
}

/** Return `{number, value, error}` of each error, in SI units: as add_values of stackbounce/explorer/answers/predictions.py. */
function addValues(drop, errors) {
  const all = numbersOf(drop);
  return Object.entries(errors).map(([path, error]) => {
    const number = all.get(path);
    if (!number) throw new InvalidValue(`${path} is not a parameter of this drop`);
    const value = valueIn(drop, number);
    if (value === undefined) throw new InvalidValue(`error of ${path} needs ${path}, which the drop does not give`);
    return { number, value, error: between(`error of ${path}`, error, 0, 1e100) };
  });
}

/** Return a drop as plain values, numbers with errors as texts: as stackbounce/prediction/prediction.py. */
function withErrors(drop, pairs) {
  const mapping = dropAt(drop, pairs.map(({ number, value }) => [number, value])).toMapping();
  for (const { number, value, error } of pairs) {
    const { part, index, field, unit } = number;
    const isRead = !/\.\d{4}/.test(unit); // a bare number is in the SI unit, too
    const text = `${writeFloat(value)} ± ${writeFloat(error)} ${isRead ? unit : ""}`.trimEnd();
    if (!part) mapping[field] = text;
    else if (field) mapping[part][index][field] = text;
    else mapping[part][index] = text;
  }
  return mapping;
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
        tables.push("", `[[${key}]]`, ...Object.entries(table).map(([name, value]) => `${name} = ${written(value)}`));
      }
    } else lines.push(`${key} = ${written(value)}`);
  }
  return `${[...lines, ...tables].join("\n")}\n`;
}

function written(value) {
  if (typeof value === "string") return JSON.stringify(value).replaceAll("\x7f", "\\u007f");
  return Array.isArray(value) ? `[${value.map(written).join(", ")}]` : writeFloat(value);
}

/** Return lines of Python that simulate a drop and draw it; `moved` has the offsets of balls off the middle. */
function writePython(drop, until, pairs, moved) {
  const { balls, contacts: _, ...rest } = drop.toMapping();
  const call = (ball) => `sb.Ball(${Object.entries(ball).map(([name, value]) => `${name}=${repr(value)}`).join(", ")})`;
  const contacts = drop.contacts.map((law) => (law === null ? "None" : `sb.${lawCode(law)}`));
  const stop = until === null ? "" : `, until=${writeFloat(until)}`;
  const pair = ({ number, value, error }) => `    ${repr(number.path)}: (${writeFloat(value)}, ${writeFloat(error)}),`;
  const run = pairs.length
    ? ["errors = {", ...pairs.map(pair), "}", `result = sb.predict(drop, errors${stop})`]
    : [`result = sb.simulate(drop${stop})`];
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
    ...run,
    'print("rebound ratios:", result.rebound_ratios)',
    ...(moved.length && !pairs.length ? [`print(result.sideways({${moved.join(", ")}}))`] : []),
    'plots.bounce(result).savefig("bounce.svg")',
  ];
  return `${lines.join("\n")}\n`;
}
