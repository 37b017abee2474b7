/** Changing the law of a contact, or calibrating it from a measured bounce. */

import { contactMass, speedOf, withValue } from "./drops.js";
import { t } from "../words/language.js";
import { clean, lawName } from "../words/words.js";

const NONE = { fields: [], loss_fields: [], rigid: false, exact: true }; // what "no floor" is among laws

/** Return what the catalogue tells of a law by its name; `laws` are the catalogue's. */
export function lawOf(laws, name) {
  return laws.find((law) => law.law === name) ?? NONE;
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
  const now = drop.contacts[contact];
  if (name === "none") return { drop: withValue(drop, `contacts.${contact}`, { law: "none" }), note: "" };
  const { rigid } = lawOf(laws, name);
  const mixed = drop.contacts.some(({ law }, i) => i !== contact && law !== "none" && lawOf(laws, law).rigid !== rigid);
  const places = mixed ? drop.contacts.map((_, i) => i).filter((i) => i === contact || drop.contacts[i].law !== "none") : [contact];
  let next = drop;
  for (const place of places) {
    next = withValue(next, `contacts.${place}`, await converted(api, name, drop, place));
  }
  const all = places.length > 1 ? `${t("All contacts are {law} now: rigid contacts and others cannot be mixed.", { law: lawName(name) })} ` : "";
  return { drop: next, note: all + kept(laws, now.law, name) };
}

/** Return a sentence on what was kept when the law of a contact was changed. */
function kept(laws, before, name) {
  if (before === "none") return "";
  if (lawOf(laws, name).rigid) return t("Restitution kept.");
  const law = { law: lawName(name) };
  if (lawOf(laws, before).rigid) {
    return loses(laws, name) ? t("A contact now lasts 5 ms, restitution kept.") : t("A contact now lasts 5 ms, {law} loses no energy.", law);
  }
  return loses(laws, name) ? t("Contact time kept, restitution kept.") : t("Contact time kept, {law} loses no energy.", law);
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

const MIXED = t("A rigid contact and others cannot be mixed: choose another law for the rigid one first.");

/**
 * Return the contact of a ball, at the floor or on the ball below, with what was measured of its bounce alone: `restitution`,
 * `contact_time` and `impact_speed`, null where not known, or the `contact` itself. A law that cannot lose becomes one that can.
 */
export async function asBounced(api, { laws, lossy_law: lossy }, drop, place, bounce) {
  const { restitution, contact_time: time, impact_speed: speed, contact: given } = bounce;
  const own = drop.contacts[place];
  const areRigid = drop.contacts.some(({ law }, i) => i !== place && lawOf(laws, law).rigid);
  if (given) {
    if (areRigid) throw new Error(MIXED);
    return tidied(given);
  }
  const kept = restitution === null ? null : Math.min(restitution, 1);
  const law = own.law === "none" || (kept !== null && kept < 1 && !loses(laws, own.law)) ? lossy : own.law;
  if (time === null) return converted(api, law, drop, place, kept);
  if (lawOf(laws, law).rigid) throw new Error(t("A rigid contact has no contact time: choose another law in the set-up first."));
  if (areRigid) throw new Error(MIXED);
  const alone = { mass: contactMass({ balls: [drop.balls[place]] }, 0), impact_speed: speed ?? speedOf(drop) };
  return tidied((await api.like({ contact: own, to: law, ...alone, restitution: kept, contact_time: time })).contact);
}

/** Return `{contact, note}`: a contact with a measured restitution and contact time, of its own law if that can lose. */
export async function asMeasured(api, { laws, lossy_law: lossy }, drop, place, { restitution, contactTime }) {
  const { law: own, exponent } = drop.contacts[place];
  const law = restitution < 1 && !loses(laws, own) ? lossy : own;
  const request = { law, mass: contactMass(drop, place), impact_speed: speedOf(drop), restitution };
  if (!lawOf(laws, law).rigid) request.contact_time = contactTime;
  if (exponent !== undefined) request.exponent = exponent;
  return { contact: tidied((await api.law(request)).contact), note: law === own ? t("As measured.") : t("As measured; {before} loses no energy, so it is {law} now.", { before: lawName(own), law: lawName(law) }) };
}
