/** Changing the law of a contact, or calibrating it from a measured bounce. */

import { contactMass, speedOf, withValue } from "./drops.js";
import { clean } from "./units.js";

const LOSSY = "Hysteretic"; // the paper's own way to lose energy
const BALL = { law: "Rigid", restitution: 0.8 }; // the reference for a contact that had no law

/**
 * Return `{drop, note}`: the drop with a contact's law changed, restitution and contact time kept
 * where the law can. All contacts change to Rigid, or away from it, together. `laws` are the catalogue's.
 */
export async function changeLaw(api, laws, drop, contact, name) {
  if (name === "none") return { drop: withValue(drop, `contacts.${contact}`, { law: "none" }), note: "" };
  const one = drop.contacts[contact];
  const others = drop.contacts.some((other, i) => i !== contact && other.law !== "none");
  const mixed = others && (one.law === "Rigid" || name === "Rigid" || rigid(drop, contact));
  const places = mixed ? drop.contacts.map((_, i) => i).filter((i) => i === contact || drop.contacts[i].law !== "none") : [contact];
  let next = drop;
  for (const place of places) {
    next = withValue(next, `contacts.${place}`, await converted(api, name, drop, place));
  }
  const all = places.length > 1 ? `All contacts are ${name} now: Rigid and other laws cannot be mixed. ` : "";
  return { drop: next, note: all + kept(laws, one.law, name) };
}

/** Return a sentence on what was kept when the law of a contact was changed. */
function kept(laws, before, name) {
  if (before === "none") return "";
  if (name === "Rigid") return "Restitution kept.";
  const time = before === "Rigid" ? "A contact now lasts 5 ms" : "Contact time kept";
  const loss = loses(laws, name) ? "restitution kept" : `${name} loses no energy`;
  return `${time}, ${loss}.`;
}

function loses(laws, name) {
  return laws.find((one) => one.law === name).loses;
}

function rigid(drop, contact) {
  return drop.contacts.some((other, i) => i !== contact && other.law === "Rigid");
}

/** Return a contact with another law, of the same restitution and contact time where possible. */
async function converted(api, name, drop, place) {
  const { law, ...numbers } = drop.contacts[place];
  const contact = law === "none" ? BALL : { law, ...numbers };
  const request = { contact, to: name, mass: contactMass(drop, place), impact_speed: speedOf(drop) };
  return tidied((await api.like(request)).contact);
}

/** Return a contact with rounded numbers, which keeps the address short. */
function tidied(contact) {
  const entries = Object.entries(contact);
  return Object.fromEntries(entries.map(([name, value]) => [name, typeof value === "number" ? clean(value) : value]));
}

/** Return `{contact, note}`: a contact with a measured restitution and contact time, of its own law if that can lose. */
export async function asMeasured(api, laws, drop, place, { restitution, contactTime }) {
  const { law: own, exponent } = drop.contacts[place];
  const law = restitution < 1 && !loses(laws, own) ? LOSSY : own;
  const request = { law, mass: contactMass(drop, place), impact_speed: speedOf(drop), restitution };
  if (law !== "Rigid") request.contact_time = contactTime;
  if (exponent !== undefined) request.exponent = exponent;
  return { contact: tidied((await api.law(request)).contact), note: law === own ? "As measured." : `As measured; ${own} loses no energy, so it is ${law} now.` };
}
