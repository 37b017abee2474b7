/** Single collisions and laws that were measured, as stackbounce/calibration has them. */

import { LAWS } from "../../made/laws.js";
import { InvalidValue, between, fraction, general, positive, shown } from "./errors.js";
import { known } from "./known.js";
import { ArithmeticError } from "./python.js";

/** Return the restitution of a collision at a speed in m/s; `mass` in kg is that of the ball, or the reduced one. */
export function restitution(law, mass, speed) {
  return measured("restitution", (m, v) => law.restitution_at(m, v), law, mass, speed);
}

/** Return the contact time in s of a collision. */
export function contactTime(law, mass, speed) {
  return measured("contact time", (m, v) => law.contact_time_at(m, v), law, mass, speed);
}

function measured(what, compute, law, mass, speed) {
  const [m, v] = [positive("mass", mass, "kilograms"), positive("speed", speed, "m/s")];
  const value = tried(() => compute(m, v));
  if (value !== null && Number.isFinite(value)) return value;
  throw new InvalidValue(`law, mass and speed must give a ${what} in the range of numbers, got ${shortCode(law)}`);
}

function shortCode(law) {
  const text = lawCode(law);
  return text.length <= 60 ? text : `${text.slice(0, 57)}...`;
}

/** Return a law as Python writes it: its name, and its numbers by name. */
export function lawCode(law) {
  const { law: name, ...numbers } = law.to_mapping();
  return `${name}(${Object.entries(numbers).map(([field, value]) => `${field}=${shown(value)}`).join(", ")})`;
}

/** Return a result, or null where numbers leave their range. */
function tried(compute) {
  try {
    return compute();
  } catch (error) {
    if (error instanceof ArithmeticError) return null;
    throw error;
  }
}

/** Return the reduced mass of two in kg. */
export function reduced(one, other) {
  const [low, high] = [Math.min(one, other), Math.max(one, other)];
  return low / (1 + low / high);
}

/** Return the law of a class that has a measured contact time and restitution. */
export function calibrate(kind, asked) {
  const name = kind.__name__;
  const given = checkedNumbers(kind, asked);
  if (!kind.loss && (given.restitution ?? 1) !== 1) {
    const right = `1 or left out for ${name}, which gives back all that it took`;
    throw new InvalidValue(`restitution must be ${right}, got ${shown(asked.restitution)}`);
  }
  const needed = kind.calibration_needs(given.exponent ?? null);
  const missing = needed.filter((one) => given[one] === undefined);
  if (missing.length) {
    throw new InvalidValue(`${missing.join(", ")} must be given to calibrate ${name}, which needs ${needed.join(", ")}`);
  }
  const law = tried(() => kind.calibrated({ impact_speed: 1, ...given }));
  if (law) return law;
  const got = Object.entries(given).map(([one, value]) => `${one}=${general(value)}`).join(", ");
  throw new InvalidValue(`what was measured must give a ${name} in the range of numbers, got ${got}`);
}

function checkedNumbers(kind, { mass, contact_time, restitution: e, impact_speed, exponent }) {
  const given = {};
  const take = (name, value, check) => {
    if (value !== undefined && value !== null) given[name] = check(value);
  };
  take("mass", mass, (value) => positive("mass", value, "kilograms"));
  take("contact_time", contact_time, (value) => positive("contact_time", value, "seconds"));
  take("restitution", e, (value) => fraction("restitution", value, { zero: kind.rigid }));
  take("impact_speed", impact_speed, (value) => positive("impact_speed", value, "m/s"));
  take("exponent", exponent, (value) => between("exponent", value, 1, known.steepest));
  const usual = kind.default_exponent();
  if (usual !== null) given.exponent ??= usual;
  const fixed = kind.fixed_exponent();
  if (fixed !== null && given.exponent !== fixed) {
    throw new InvalidValue(`exponent must be ${general(fixed)} or left out for ${kind.__name__}, got ${shown(exponent)}`);
  }
  return given;
}

/** Return the class of the law without a contact time. */
export function rigidLaw() {
  return Object.values(LAWS).find((kind) => kind.rigid);
}

/** Return a drop by separate collisions, one after the other from below: the textbook's model. */
export function separate(drop) {
  const contacts = collisions(drop);
  if (drop.gravity === 0) return drop.changed({ contacts });
  if (drop.height === undefined) return drop.changed({ contacts, gravity: 0 });
  return drop.changed({ contacts, gravity: 0, height: undefined, impact_speed: drop.speed });
}

function collisions(drop) {
  const kind = rigidLaw();
  let below = 0; // velocity of what lies below: the floor, then the ball after its own collision
  return drop.contacts.map((law, i) => {
    const [own, { mass }] = [drop.start[i], drop.balls[i]];
    if (law === null) {
      below = own;
      return null;
    }
    const moving = i === 0 ? mass : reduced(drop.balls[i - 1].mass, mass);
    const closing = Math.min(below - own, Number.MAX_VALUE);
    const e = restitution(law, moving, closing > 0 ? closing : drop.speed);
    below = own + (((1 + e) * moving) / mass) * Math.max(0, closing);
    return kind.make([e]);
  });
}

