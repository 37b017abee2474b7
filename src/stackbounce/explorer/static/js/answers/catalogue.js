/** Stacks of the catalogue's balls, and laws that were measured: as stackbounce/explorer/answers/catalogue.py. */

import { calibrate, contactTime, restitution, rigidLaw } from "../model/calibration.js";
import { Drop } from "../model/drop.js";
import { known } from "../model/known.js";
import { lawNamed, readLaw } from "../model/schema.js";

/** Stack balls of the catalogue: the drop, and the sources of its numbers. */
export function stackBalls(names, height) {
  const { stacks } = known;
  const pair = (lower, upper) => stacks[`${lower} ${upper}`]; // of the paper's balls only
  const contacts = names.map((name, i) => (i === 0 ? floorOf(names, pair) : betweenOf(names[i - 1], name, pair)));
  const gaps = names.slice(1).map((name, i) => pair(names[i], name)?.[i === 0 ? "gap" : "other_gap"] ?? NO_GAP);
  const drop = new Drop({
    balls: names.map((name) => Drop.ball({ mass: entryOf(name).mass, diameter: entryOf(name).diameter, name })),
    contacts: contacts.map(([law]) => law),
    gaps: gaps.map(([gap]) => gap),
    height,
  });
  return { drop: drop.toMapping(), contact_sources: contacts.map(([, source]) => source), gap_sources: gaps.map(([, source]) => source) };
}

const NO_GAP = [0, "no gap given"];

function entryOf(name) {
  return known.balls.find((ball) => ball.name === name);
}

function floorOf([name, upper], pair) {
  const [law, source] = pair(name, upper)?.floor ?? [known.contacts[name].floor, entryOf(name).sources.stiffness];
  return [readLaw(law, "contacts.0"), source];
}

/** Return the contact between two balls: the paper's, or both floor contacts in series with the loss of both. */
function betweenOf(lower, upper, pair) {
  const fitted = pair(lower, upper)?.between;
  if (fitted) return [readLaw(fitted[0], "contact"), fitted[1]];
  const [one, other] = [lower, upper].map((name) => readLaw(known.contacts[name].pressed, "contact"));
  return [one.pressed_on(other), `${lower} and ${upper} in series`];
}

/** Find the constants of a law from restitution and contact time. */
export function calibrateLaw({ law, ...measured }) {
  return { contact: calibrate(lawNamed(law), measured).to_mapping() };
}

/** Find another law with the restitution and contact time of a contact. */
export function convertLaw({ contact: given, to, mass, impact_speed: speed, restitution: e = null, contact_time: time = null }) {
  const contact = readLaw(given, "contact") ?? rigidLaw().make([known.usual.restitution]);
  const law = lawNamed(to);
  const asked = { impact_speed: speed, mass, contact_time: time ?? (contactTime(contact, mass, speed) || known.usual.contact_time) };
  if (law.loss) asked.restitution = e ?? restitution(contact, mass, speed);
  if (law.default_exponent() === null && !law.rigid) asked.exponent = contact.exponent ?? known.usual.exponent;
  return { contact: calibrate(law, asked).to_mapping() };
}
