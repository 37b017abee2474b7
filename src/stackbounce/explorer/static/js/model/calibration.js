/** Single collisions and laws that were measured, as stackbounce/run/collision.py and calibration.py have them. */

import { LAW_CODE } from "../../made/laws.js";
import { InvalidValue, between, fraction, general, positive, repr } from "./errors.js";
import { known } from "./known.js";
import { Law, rigidKind } from "./law.js";
import { OutOfRange, bounce } from "./one_ball.js";

const LOSSLESS = 1 - 1e-11; // a smaller loss is not told from round-off in a simulation

/** Return the restitution of a collision at a speed in m/s; `mass` in kg is that of the ball, or the reduced one. */
export function restitution(law, mass, speed) {
  return measured("restitution", restitutionAt, law, mass, speed);
}

function restitutionAt(law, mass, speed) {
  const { loss, constant_loss: constant } = law.kind;
  if (!loss) return 1;
  if (constant && loss === "restitution") return law.restitution;
  return bounce(law.scatter ? law.replaced({ scatter: 0 }) : law, mass, speed)[0];
}

/** Return the contact time in s of a collision. */
export function contactTime(law, mass, speed) {
  return measured("contact time", contactTimeAt, law, mass, speed);
}

function contactTimeAt(law, mass, speed) {
  return law.rigid ? 0 : bounce(law, mass, speed)[1];
}

function measured(what, compute, law, mass, speed) {
  const [m, v] = [positive("mass", mass, "kilograms"), positive("impact_speed", speed, "m/s")];
  const value = tried(() => compute(law, m, v));
  if (value !== null && Number.isFinite(value)) return value;
  throw new InvalidValue(`law, mass and impact_speed must give a ${what} in the range of numbers, got ${shortCode(law)}`);
}

function shortCode(law) {
  const text = lawCode(law);
  return text.length <= 60 ? text : `${text.slice(0, 57)}...`;
}

/** Return a law as Python writes it: its name, and its numbers by name. */
export function lawCode(law) {
  const { law: name, ...numbers } = law.toMapping();
  return `${name}(${Object.entries(numbers).map(([field, value]) => `${field}=${repr(value)}`).join(", ")})`;
}

/** Return a result, or null where numbers leave their range. */
function tried(compute) {
  try {
    return compute();
  } catch (error) {
    if (error instanceof OutOfRange) return null;
    throw error;
  }
}

/** Return the reduced mass of two in kg. */
export function reduced(one, other) {
  const [low, high] = [Math.min(one, other), Math.max(one, other)];
  return low / (1 + low / high);
}

/** Return the law of a kind that has a measured contact time and restitution. */
export function calibrate(kind, asked) {
  const name = kind.law;
  const given = checkedNumbers(kind, asked);
  if (!kind.loss && (given.restitution ?? 1) !== 1) {
    const right = `1 or left out for ${name}, which gives back all that it took`;
    throw new InvalidValue(`restitution must be ${right}, got ${repr(asked.restitution)}`);
  }
  const needed = (given.exponent ?? 1) === 1 ? kind.needs.linear : kind.needs.other;
  const missing = needed.filter((one) => given[one] === undefined);
  if (missing.length) {
    throw new InvalidValue(`${missing.join(", ")} must be given to calibrate ${name}, which needs ${needed.join(", ")}`);
  }
  const law = tried(() => calibrated(kind, { impact_speed: 1, ...given }));
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
  const { usual_exponent: usual, exponent: fixed } = kind;
  if (usual !== null) given.exponent ??= usual;
  if (fixed !== null && given.exponent !== fixed) {
    throw new InvalidValue(`exponent must be ${general(fixed)} or left out for ${kind.law}, got ${repr(exponent)}`);
  }
  return given;
}

/** Return the law that has the contact time, and the restitution if it has a loss: both are searched for by bounces. */
function calibrated(kind, given) {
  const { mass, impact_speed: speed, contact_time: lasts, restitution: kept, exponent: p } = given;
  if (kind.rigid) return new Law(kind, { restitution: kept, speed });
  if (kept < kind.least_restitution) {
    throw new InvalidValue(`restitution must be at least ${general(kind.least_restitution, 3)} for a ${kind.law}, got ${general(kept)}`);
  }
  const numbers = Object.fromEntries(kind.fields.map(({ name, usual, start }) => [name, given[name] ?? (usual === undefined ? start : usual)]));
  const share = 1 / (p + 1);
  const span = (lasts * speed) / (2 + share * (2.7726 - 0.979 * share)); // m, about the compression of a power law
  let stiffness = (0.5 * (p + 1) * mass * (speed / span) ** 2) / span ** (p - 1);
  const law = (changed) => new Law(kind, { ...numbers, ...changed, ...LAW_CODE[kind.law]?.others?.(given, changed) });
  const lasting = (loss) => {
    const short = (k) => (lasts / contactTimeAt(law({ ...loss, stiffness: k }), mass, speed)) ** (p + 1) - 1; // linear in k for a power law
    stiffness = risingRoot(short, stiffness); // near which the next one is
    return law({ ...loss, stiffness });
  };
  if (["", "restitution"].includes(kind.loss)) return lasting({});
  if (kept > LOSSLESS) return lasting({ [kind.loss]: 0 });
  const excess = (loss) => Math.log(kept / restitutionAt(lasting({ [kind.loss]: loss }), mass, speed));
  return lasting({ [kind.loss]: risingRoot(excess, numbers[kind.loss]) });
}

const WIDEST = 10; // times, from one end of a bracket to the next
const CLOSEST = 1e-15; // relative
const ROUNDS = 200;

/** Return the zero of a function that rises with a number above 0, near a start or far from it. */
function risingRoot(compute, start) {
  const value = (x) => {
    if (!(x > 1e-307 && x < Infinity)) throw new OutOfRange();
    return compute(x);
  };
  let [before, x, valueNow] = [start, start, value(start)];
  let valueBefore = valueNow;
  const below = valueNow < 0;
  for (let factor = 1.1; valueNow < 0 === below && valueNow !== 0; factor = Math.min(factor * factor, WIDEST)) {
    [before, valueBefore] = [x, valueNow];
    x = below ? x * factor : x / factor;
    valueNow = value(x);
  }
  // the secant rule, with half the value of an end that stays (the Illinois rule)
  for (let round = 0; round < ROUNDS && valueNow !== 0 && Math.abs(x - before) > CLOSEST * x; round += 1) {
    const next = x - (valueNow * (x - before)) / (valueNow - valueBefore);
    const valueNext = value(next);
    if (valueNext < 0 === valueNow < 0) valueBefore /= 2;
    else [before, valueBefore] = [x, valueNow];
    if (next === x) break;
    [x, valueNow] = [next, valueNext];
  }
  return x;
}

/** Return a drop by separate collisions, one after the other from below: the textbook's model. */
export function separate(drop) {
  const contacts = collisions(drop);
  if (drop.gravity === 0) return drop.changed({ contacts });
  if (drop.height === undefined) return drop.changed({ contacts, gravity: 0 });
  return drop.changed({ contacts, gravity: 0, height: undefined, impact_speed: drop.speed });
}

function collisions(drop) {
  const kind = rigidKind();
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
    return new Law(kind, { restitution: e });
  });
}

