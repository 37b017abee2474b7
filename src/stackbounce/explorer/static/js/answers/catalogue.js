/** Stacks of the catalogue's balls, and laws that were measured. */

import { calibrate, contactTime, restitution } from "../model/calibration.js";
import { Drop } from "../model/drop.js";
import { known } from "../model/known.js";
import { Law, rigidKind } from "../model/law.js";
import { kindNamed, readLaw } from "../model/schema.js";

/** Stack balls of the catalogue: the drop, and the sources of its numbers. */
export function stackBalls(names, height) {
  const pairs = names.slice(1).map((name, i) => known.stacks[`${names[i]} ${name}`]);
  const contacts = [pairs[0]?.floor ?? known.contacts[names[0]], ...pairs.map(({ between }) => between)];
  const gaps = pairs.map(({ gap }, i) => (i === 0 && gap ? gap : NO_GAP));
  const drop = new Drop({
    balls: names.map((name) => Drop.ball({ mass: entryOf(name).mass, diameter: entryOf(name).diameter, name })),
    contacts: contacts.map(([law]) => readLaw(law, "contact")),
    gaps: gaps.map(([gap]) => gap),
    height,
  });
  return { drop: drop.toMapping(), contact_sources: contacts.map(([, source]) => source), gap_sources: gaps.map(([, source]) => source) };
}

const NO_GAP = [0, "no gap given"];

function entryOf(name) {
  return known.balls.find((ball) => ball.name === name);
}

/** Find the constants of a law from restitution and contact time. */
export function calibrateLaw({ law, ...measured }) {
  return { contact: calibrate(kindNamed(law), measured).toMapping() };
}

/** Find another law with the restitution and contact time of a contact. */
export function convertLaw({ contact: given, to, mass, impact_speed: speed, restitution: e = null, contact_time: time = null }) {
  const contact = readLaw(given, "contact") ?? new Law(rigidKind(), { restitution: known.usual.restitution });
  const kind = kindNamed(to);
  const asked = { impact_speed: speed, mass, contact_time: time ?? (contactTime(contact, mass, speed) || known.usual.contact_time) };
  if (kind.loss) asked.restitution = e ?? restitution(contact, mass, speed);
  if (kind.usual_exponent === null && !kind.rigid) asked.exponent = contact.exponent ?? known.usual.exponent;
  return { contact: calibrate(kind, asked).toMapping() };
}
