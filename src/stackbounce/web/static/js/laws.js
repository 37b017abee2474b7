/** Contacts with another law, or with the law's constants for a bounce that was measured. */

import { contactMass, speedOf, withValue } from "./drops.js";

/** Return a contact of a law with the catalogue's defaults. */
function plain(law) {
  const fields = law.fields.filter((field) => field.required || field.default !== null);
  return { law: law.law, ...Object.fromEntries(fields.map((field) => [field.name, field.default])) };
}

/**
 * Return `{drop, note}`: the drop with a contact's law changed, restitution and contact time kept
 * where the law can. All contacts change to Rigid, or away from it, together.
 */
export async function changeLaw(api, laws, drop, contact, name) {
  if (name === "none") return { drop: withValue(drop, `contacts.${contact}`, { law: "none" }), note: "" };
  const one = drop.contacts[contact];
  const others = drop.contacts.some((other, i) => i !== contact && other.law !== "none");
  const mixed = others && (one.law === "Rigid" || name === "Rigid" || rigid(drop, contact));
  const places = mixed ? drop.contacts.map((_, i) => i).filter((i) => i === contact || drop.contacts[i].law !== "none") : [contact];
  let next = drop;
  let kept = true;
  for (const place of places) {
    const law = laws.find((entry) => entry.law === name);
    const changed = await converted(api, law, drop, place);
    kept &&= changed.kept;
    next = withValue(next, `contacts.${place}`, changed.contact);
  }
  const all = mixed && places.length > 1 ? `All contacts are ${name} now: Rigid and other laws cannot be mixed. ` : "";
  return { drop: next, note: all + (kept ? "" : `${name} has its usual constants here.`) };
}

function rigid(drop, contact) {
  return drop.contacts.some((other, i) => i !== contact && other.law === "Rigid");
}

/** Return a contact with another law, as like the one before as it can be. */
async function converted(api, law, drop, place) {
  const contact = drop.contacts[place];
  const common = { mass: contactMass(drop, place), impact_speed: speedOf(drop) };
  try {
    if (contact.law === "none") return { contact: plain(law), kept: true };
    return { contact: (await api.like({ contact, to: law.law, ...common })).contact, kept: true };
  } catch (error) {
    if (error.offline) throw error;
    return { contact: plain(law), kept: false };
  }
}

/** Return the contact of the law it has that shows a measured restitution and contact time. */
export async function asMeasured(api, drop, place, { restitution, contactTime }) {
  const { law, exponent } = drop.contacts[place];
  const request = { law, mass: contactMass(drop, place), impact_speed: speedOf(drop), restitution };
  if (law !== "Rigid") request.contact_time = contactTime;
  if (exponent !== undefined) request.exponent = exponent;
  return (await api.law(request)).contact;
}
