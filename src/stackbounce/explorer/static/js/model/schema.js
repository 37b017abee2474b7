/** Reads a drop from plain values in SI units, as stackbounce/model/toml.py does. */

import { Drop } from "./drop.js";
import { InvalidValue } from "./errors.js";
import { known } from "./known.js";
import { Law } from "./law.js";

const NO_FLOOR = "none";

/** The units of a ball's numbers. */
export const BALL = { mass: "kg", diameter: "m", young_modulus: "Pa", poisson_ratio: "" };

/** Return the drop that a mapping describes, within the limits of the explorer. */
export function readDrop({ balls, contacts, ...rest }) {
  const given = Object.fromEntries(Object.entries(rest).filter(([, value]) => value !== null));
  for (const many of [balls, contacts, given.gaps, given.velocities]) {
    if (many?.length > known.limits.balls) throw new InvalidValue(`balls must be at most ${known.limits.balls} in the explorer, got ${many.length}`);
  }
  return new Drop({
    ...given,
    balls: balls.map((ball, i) => under(`balls.${i}`, () => Drop.ball(ball))),
    contacts: contacts.map((contact, i) => readLaw(contact, `contacts.${i}`)),
  });
}

/** Return the contact law that a mapping describes; null for no floor. */
export function readLaw({ law: name, ...values }, path) {
  if (name === NO_FLOOR) return null;
  return under(path, () => new Law(kindNamed(name), values));
}

/** Return the kind of a law by its name. */
export function kindNamed(name) {
  if (Object.hasOwn(known.models, name)) return known.models[name];
  throw new InvalidValue(`law must be a contact law, got ${name}; known: ${Object.keys(known.models).join(", ")}`);
}

/** Do something; where it fails, the path of what it read comes first in the message. */
export function under(path, act) {
  try {
    return act();
  } catch (error) {
    if (error instanceof InvalidValue) throw new InvalidValue(`${path}.${error.message}`);
    throw error;
  }
}
