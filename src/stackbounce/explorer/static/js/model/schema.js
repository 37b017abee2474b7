/** Reads a drop from what somebody gave, as stackbounce/model/toml.py does: same numbers, same words. */

import { Drop } from "./drop.js";
import { InvalidValue, Wrong, between, nearest, shown, shownAsGiven, writeFloat } from "./errors.js";
import { known } from "./known.js";
import { Law } from "./law.js";
import { quantity } from "./units.js";

export const NO_FLOOR = "none";

const JOINED = /[-_]/g;
const NAME = /^[\p{XID_Start}_][\p{XID_Continue}]*$/u;
const DROP = {
  balls: { required: true },
  contacts: { required: true },
  gaps: { unit: "m" },
  impact_speed: { unit: "m/s" },
  height: { unit: "m" },
  velocities: { unit: "m/s" },
  gravity: { unit: "m/s**2" },
};
export const BALL = {
  mass: { required: true, unit: "kg" },
  diameter: { unit: "m" },
  name: {},
  young_modulus: { unit: "Pa" },
  poisson_ratio: { unit: "" },
};

/** Return the drop that a mapping describes, within the limits of the explorer. */
export function readDrop(mapping) {
  const given = isTable(mapping) ? mapping : {};
  for (const name of ["balls", "contacts", "gaps", "velocities"]) {
    const many = given[name];
    if (Array.isArray(many) && many.length > known.limits.balls) {
      throw new InvalidValue(`${name} must be at most ${known.limits.balls} in the explorer, got ${many.length}`);
    }
  }
  const table = tableOf(mapping, "the scenario");
  checkKeys(DROP, table, "");
  const { balls, contacts, ...rest } = table;
  const values = readValues(DROP, rest, "");
  values.balls = each(readBall, balls, "balls");
  values.contacts = each(readLaw, contacts, "contacts");
  return new Drop(values);
}

function readBall(value, path) {
  const table = tableOf(value, path);
  checkKeys(BALL, table, path);
  const values = readValues(BALL, table, path);
  return under(path, () => Drop.ball(values));
}

/** Return the contact law that a mapping describes; null for no floor. */
export function readLaw(value, path) {
  const { law: name, ...table } = tableOf(value, path);
  if (name === undefined) throw new InvalidValue(`${path}.law is missing; ${nearest("", [...Object.keys(known.models), NO_FLOOR])}`);
  if (typeof name === "string" && name.toLowerCase() === NO_FLOOR) {
    if (Object.keys(table).length) throw new InvalidValue(`${path}.law = "${NO_FLOOR}" has no numbers, got ${shownAsGiven(table)}`);
    return null;
  }
  let kind = null;
  under(path, () => (kind = kindNamed(name)), `, ${NO_FLOOR}`);
  const fields = fieldsOf(kind);
  checkKeys(fields, table, path);
  const exponent = "exponent" in table ? readValue("exponent", table.exponent, fields, path, 1) : 1;
  const values = readValues(fields, table, path, exponent);
  return under(path, () => new Law(kind, values));
}

/** Return the kind of a law by its name; case, hyphens and underscores do not matter. */
export function kindNamed(name) {
  const word = typeof name === "string" ? name.toLowerCase().replace(JOINED, "") : "";
  const found = Object.values(known.models).find(({ law }) => law.toLowerCase() === word);
  if (found) return found;
  throw new InvalidValue(`law must be a contact law, got ${shownAsGiven(name)}; ${nearest(name, Object.keys(known.models))}`);
}

function fieldsOf(kind) {
  return Object.fromEntries(kind.fields.map(({ name, usual, unit }) => [name, { required: usual === undefined, unit }]));
}

function isTable(value) {
  return value !== null && typeof value === "object" && !Array.isArray(value);
}

function tableOf(value, path) {
  if (!isTable(value)) throw new InvalidValue(`${path} must be a table of keys and values, got ${shownAsGiven(value)}`);
  return Object.fromEntries(Object.entries(value).filter(([, one]) => one !== null && one !== undefined));
}

function checkKeys(fields, table, path) {
  for (const key of Object.keys(table)) {
    if (Object.hasOwn(fields, key)) continue;
    const name = NAME.test(key) && [...key].length < 60 ? key : shown(key);
    throw new InvalidValue(`${joined(path, name)} is not a known key; ${nearest(key, Object.keys(fields))}`);
  }
  for (const [name, { required }] of Object.entries(fields)) {
    if (required && !Object.hasOwn(table, name)) throw new InvalidValue(`${joined(path, name)} is missing`);
  }
}

function each(read, values, path) {
  if (!Array.isArray(values)) throw new InvalidValue(`${path} must be a list of tables, got ${shownAsGiven(values)}`);
  return values.map((value, i) => read(value, `${path}.${i}`));
}

function readValues(fields, table, path, exponent = 1) {
  return Object.fromEntries(Object.entries(table).map(([key, one]) => [key, readValue(key, one, fields, path, exponent)]));
}

function readValue(key, value, fields, path, exponent) {
  let { unit } = fields[key];
  if (unit === undefined) return asGiven(value);
  if (unit.includes("exponent")) {
    between(`${path}.exponent`, exponent, 1, known.steepest);
    unit = unit.replace("**exponent", exponent === 1 ? "" : `**${writeFloat(exponent)}`);
  }
  const name = joined(path, key);
  if (Array.isArray(value)) return value.map((one, i) => quantity(one, unit, `${name}.${i}`));
  return quantity(value, unit, name);
}

/** Return a value that is not read as a number: whole numbers stay whole, in a message too. */
function asGiven(value) {
  if (Number.isInteger(value) && Math.abs(value) < 1e21) return BigInt(String(value));
  if (Array.isArray(value)) return value.map(asGiven);
  return isTable(value) ? Object.fromEntries(Object.entries(value).map(([key, one]) => [key, asGiven(one)])) : value;
}

/** Do something; where it fails, the path of what it read comes first in the message. */
export function under(path, act, ending = "") {
  try {
    return act();
  } catch (error) {
    if (error instanceof Wrong) throw new InvalidValue(`${joined(path, error.message)}${ending}`);
    throw error;
  }
}

function joined(path, key) {
  return path ? `${path}.${key}` : key;
}
