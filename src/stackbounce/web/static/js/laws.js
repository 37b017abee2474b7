/** Changing the law of a contact, or calibrating it from a measured bounce. */

import { contactMass, speedOf, withValue } from "./drops.js";
import { clean } from "./units.js";

const NONE = { fields: [], loss_fields: [], rigid: false, exact: true }; // what "no floor" is among laws

/** Return what the catalogue tells of a law by its name; `laws` are the catalogue's. */
export function lawOf(laws, name) {
  return laws.find((one) => one.law === name) ?? NONE;
}

/** Return the field of a contact that sets its loss of energy, undefined where nothing is lost. */
export function lossOf(laws, contact) {
  return lawOf(laws, contact.law).loss_fields.find((name) => contact[name] !== undefined);
}

/** Return a contact of the first law of the catalogue, with the numbers that its sliders begin with. */
export function firstContact([{ law, fields }]) {
  const needed = fields.filter(({ required }) => required);
  return { law, ...Object.fromEntries(needed.map(({ name, default: value }) => [name, value])) };
}

/**
 * Return `{drop, note}`: the drop with a contact's law changed, restitution and contact time kept
 * where the law can. All contacts change to a rigid law, or away from it, together. `laws` are the catalogue's.
 */
export async function changeLaw(api, laws, drop, contact, name) {
  if (name === "none") return { drop: withValue(drop, `contacts.${contact}`, { law: "none" }), note: "" };
  const one = drop.contacts[contact];
  const others = drop.contacts.some((other, i) => i !== contact && other.law !== "none");
  const rigid = (law) => lawOf(laws, law).rigid;
  const mixed = others && (rigid(one.law) || rigid(name) || drop.contacts.some(({ law }, i) => i !== contact && rigid(law)));
  const places = mixed ? drop.contacts.map((_, i) => i).filter((i) => i === contact || drop.contacts[i].law !== "none") : [contact];
  let next = drop;
  for (const place of places) {
    next = withValue(next, `contacts.${place}`, await converted(api, name, drop, place));
  }
  const all = places.length > 1 ? `All contacts are ${name} now: rigid contacts and others cannot be mixed. ` : "";
  return { drop: next, note: all + kept(laws, one.law, name) };
}

/** Return a sentence on what was kept when the law of a contact was changed. */
function kept(laws, before, name) {
  if (before === "none") return "";
  if (lawOf(laws, name).rigid) return "Restitution kept.";
  const time = lawOf(laws, before).rigid ? "A contact now lasts 5 ms" : "Contact time kept";
  const loss = loses(laws, name) ? "restitution kept" : `${name} loses no energy`;
  return `${time}, ${loss}.`;
}

function loses(laws, name) {
  return lawOf(laws, name).loss_fields.length > 0;
}

/** Return a contact with another law, of the same contact time and of a restitution, by default the same, where possible. */
export async function converted(api, name, drop, place, restitution = null) {
  const contact = drop.contacts[place];
  const request = { contact, to: name, mass: contactMass(drop, place), impact_speed: speedOf(drop), restitution };
  return tidied((await api.like(request)).contact);
}

/** Return a contact with rounded numbers, which keeps the address short. */
function tidied(contact) {
  const entries = Object.entries(contact);
  return Object.fromEntries(entries.map(([name, value]) => [name, typeof value === "number" ? clean(value) : value]));
}

/** Return `{contact, note}`: a contact with a measured restitution and contact time, of its own law if that can lose. */
export async function asMeasured(api, { laws, lossy_law: lossy }, drop, place, { restitution, contactTime }) {
  const { law: own, exponent } = drop.contacts[place];
  const law = restitution < 1 && !loses(laws, own) ? lossy : own;
  const request = { law, mass: contactMass(drop, place), impact_speed: speedOf(drop), restitution };
  if (!lawOf(laws, law).rigid) request.contact_time = contactTime;
  if (exponent !== undefined) request.exponent = exponent;
  return { contact: tidied((await api.law(request)).contact), note: law === own ? "As measured." : `As measured; ${own} loses no energy, so it is ${law} now.` };
}
