/** Stacks of the catalogue's balls, and laws that were measured: as stackbounce/web/answers/catalogue.py. */

import { calibrate, contactTime, restitution, rigidLaw } from "../model/calibration.js";
import { Drop } from "../model/drop.js";
import { known } from "../model/known.js";
import { lawNamed, readLaw } from "../model/schema.js";

/** Stack balls of the catalogue: the drop, and the sources of its numbers. */
export function stackBalls(names, height) {
  const { stacks, balls } = known;
  const entry = (name) => balls.find((one) => one.name === name);
  const pair = (lower, upper) => stacks[`${lower} ${upper}`];
  const lowest = names.length > 1 ? pair(names[0], names[1]) : null;
  const floors = lowest?.floor ?? [entry(names[0]).stiffness, entry(names[0]).sources.stiffness];
  const contacts = [floors, ...names.slice(1).map((name, i) => pair(names[i], name).between)];
  const gaps = names.slice(1).map((_, i) => (i === 0 ? lowest.gap : pair(names[i], names[i + 1]).other_gap));
  const laws = contacts.map(([stiffness]) => ({ ...known.catalogue_law, stiffness }));
  const drop = new Drop({
    balls: names.map((name) => Drop.ball({ mass: entry(name).mass, diameter: entry(name).diameter, name })),
    contacts: laws.map((law, i) => readLaw(law, `contacts.${i}`)),
    gaps: gaps.map(([gap]) => gap),
    height,
  });
  return { drop: drop.toMapping(), contact_sources: contacts.map(([, source]) => source), gap_sources: gaps.map(([, source]) => source) };
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
