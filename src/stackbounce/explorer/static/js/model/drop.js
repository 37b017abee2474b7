/** A drop, checked, as stackbounce/model/drop.py has it. */

import { InvalidValue, between, finite, nonNegative, positive, writeFloat } from "./errors.js";
import { known } from "./known.js";

const INCIDENCE = ["impact_speed", "height", "velocities"];

export class Drop {
  /** Take values in SI units; balls and contacts are checked already. */
  constructor(values) {
    const { balls, contacts } = values;
    this.balls = balls;
    this.contacts = contacts;
    const gaps = values.gaps ?? balls.slice(1).map(() => 0);
    if (!balls.length) throw new InvalidValue("balls must hold at least one ball, got none");
    checkContacts(contacts, balls.length);
    if (gaps.length !== balls.length - 1) {
      const right = `one number per neighbouring pair of balls (${balls.length - 1})`;
      throw new InvalidValue(`gaps must hold ${right}, got ${gaps.length}`);
    }
    this.gaps = gaps.map((gap, i) => nonNegative(`gaps.${i}`, gap, "metres"));
    const gravity = nonNegative("gravity", values.gravity ?? 0, "m/s**2");
    Object.assign(this, incidence(values, balls.length));
    this.gravity = gravity;
    if (!(this.speed > 0 && this.speed < Infinity)) {
      const at = `${writeFloat(this.pull)} m/s**2, got ${writeFloat(this.height)}`;
      throw new InvalidValue(`height must give an impact speed above 0 and finite at ${at}`);
    }
  }

  /** Return a ball of values in SI units, checked. */
  static ball({ mass, diameter, name, young_modulus: modulus, poisson_ratio: ratio }) {
    const ball = { mass: positive("mass", mass, "kilograms") };
    if (diameter !== undefined) ball.diameter = positive("diameter", diameter, "metres");
    if (modulus !== undefined) ball.young_modulus = positive("young_modulus", modulus, "pascals");
    if (name !== undefined) ball.name = name;
    if (ratio === -1) throw new InvalidValue("poisson_ratio must be above -1, got -1.0");
    if (ratio !== undefined) ball.poisson_ratio = between("poisson_ratio", ratio, -1, 0.5);
    return ball;
  }

  /** The acceleration in m/s² of the fall before the impact. */
  get pull() {
    return this.gravity || known.gravity;
  }

  /** The impact speed in m/s, the unit of rebound ratios; or the largest start speed. */
  get speed() {
    if (this.impact_speed !== undefined) return this.impact_speed;
    if (this.height !== undefined) return Math.sqrt(2 * this.pull * this.height);
    return Math.max(...this.velocities.map(Math.abs));
  }

  /** The velocities in m/s at the start, up is positive. */
  get start() {
    return this.velocities ?? this.balls.map(() => -this.speed);
  }

  get rigid() {
    return this.contacts.every((law) => law === null || law.rigid);
  }

  /** Return the drop with some of its values changed, checked again. */
  changed(values) {
    const { balls, contacts, gaps, impact_speed, height, velocities, gravity } = { ...this, ...values };
    return new Drop({ balls, contacts, gaps, impact_speed, height, velocities, gravity });
  }

  /** Return the drop as plain values, in the order of a scenario file. */
  toMapping() {
    const given = { gaps: this.gaps, impact_speed: this.impact_speed, height: this.height, velocities: this.velocities };
    const plain = Object.fromEntries(Object.entries(given).filter(([, value]) => value !== undefined));
    const contacts = this.contacts.map((law) => (law === null ? { law: "none" } : law.toMapping()));
    return { ...plain, gravity: this.gravity, balls: this.balls.map(inOrder), contacts };
  }
}

function inOrder({ mass, diameter, name, young_modulus, poisson_ratio }) {
  const all = { mass, diameter, name, young_modulus, poisson_ratio };
  return Object.fromEntries(Object.entries(all).filter(([, value]) => value !== undefined));
}

function checkContacts(contacts, count) {
  if (contacts.length !== count) {
    throw new InvalidValue(`contacts must hold one law per ball, the one below it (${count}), got ${contacts.length}`);
  }
  contacts.forEach((law, i) => {
    if (law === null && i > 0) throw new InvalidValue(`contacts.${i} must be a contact law, got None (for the floor only)`);
  });
  const rigid = contacts.findIndex((law) => law?.rigid);
  const other = contacts.findIndex((law) => law && !law.rigid);
  if (rigid < 0 || other < 0) return;
  throw new InvalidValue(
    "contacts must be all rigid or have none that is, got a mixture: " +
      `contacts.${rigid} is ${contacts[rigid].kind.law} and contacts.${other} is ${contacts[other].kind.law}`,
  );
}

function incidence(values, count) {
  const given = INCIDENCE.filter((name) => values[name] !== undefined);
  if (given.length !== 1) {
    const all = "impact_speed, height and velocities: exactly one of the three must be given";
    throw new InvalidValue(`${all}, got ${given.join(" and ") || "none"}`);
  }
  if (values.impact_speed !== undefined) return { impact_speed: positive("impact_speed", values.impact_speed, "m/s") };
  if (values.height !== undefined) return { height: positive("height", values.height, "metres") };
  const { velocities } = values;
  if (velocities.length !== count) {
    throw new InvalidValue(`velocities must hold one number per ball (${count}), got ${velocities.length}`);
  }
  velocities.forEach((velocity, i) => finite(`velocities.${i}`, velocity, "m/s"));
  if (velocities.every((velocity) => velocity === 0)) throw new InvalidValue("velocities must not all be 0, got 0 for every ball");
  return { velocities };
}
