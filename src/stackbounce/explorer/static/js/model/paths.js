/** The numbers of a drop by their paths, such as contacts.1.stiffness: as stackbounce/run/paths.py. */

import { Drop } from "./drop.js";
import { general } from "./errors.js";
import { BALL, under } from "./schema.js";

const ALONE = { impact_speed: "m/s", height: "m", gravity: "m/s**2" };

/** Return all numbers of a drop that can vary, `{path, part, index, field, unit}`, by path. */
export function numbersOf(drop) {
  const found = [];
  const add = (part, index, field, unit) => found.push({ path: [part, index, field].filter((one) => one !== "").join("."), part, index, field, unit });
  drop.balls.forEach((_, i) => {
    for (const [name, unit] of Object.entries(BALL)) add("balls", i, name, unit);
  });
  drop.contacts.forEach((law, i) => {
    for (const [name, unit] of Object.entries(unitsOf(law))) add("contacts", i, name, unit);
  });
  drop.gaps.forEach((_, i) => add("gaps", i, "", "m"));
  drop.velocities?.forEach((_, i) => add("velocities", i, "", "m/s"));
  for (const [name, unit] of Object.entries(ALONE)) if (drop[name] !== undefined) add("", "", name, unit);
  return new Map(found.map((number) => [number.path, number]));
}

/** Return the units of a law's numbers, such as N/m**1.5 for an exponent of 1.5. */
function unitsOf(law) {
  if (law === null) return {};
  const exponent = law.exponent ?? 1;
  const power = exponent === 1 ? "" : `**${general(exponent)}`;
  return Object.fromEntries(law.kind.fields.map(({ name, unit }) => [name, unit.replace("**exponent", power)]));
}

/** Return a number of a drop; undefined for one that is not given. */
export function valueIn(drop, { part, index, field }) {
  const place = part ? drop[part][index] : drop;
  return field ? place[field] : place;
}

/** Return a copy of a drop in which some numbers, `[number, value]`, are others; it is checked again. */
export function dropAt(drop, values) {
  const changes = { balls: [...drop.balls], contacts: [...drop.contacts], gaps: [...drop.gaps] };
  if (drop.velocities) changes.velocities = [...drop.velocities];
  const within = new Map();
  for (const [{ part, index, field }, value] of values) {
    const place = `${part}.${index}`;
    if (!part) changes[field] = value;
    else if (field) within.set(place, { part, index, fields: { ...within.get(place)?.fields, [field]: value } });
    else changes[part][index] = value;
  }
  for (const [place, { part, index, fields }] of within) {
    const own = drop[part][index];
    changes[part][index] = under(place, () => (part === "balls" ? Drop.ball({ ...own, ...fields }) : own.replaced(fields)));
  }
  return drop.changed(changes);
}
