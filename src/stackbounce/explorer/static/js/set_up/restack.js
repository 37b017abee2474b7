/** Contacts belong to the balls that make them: what becomes of them where balls come, go or change places. */

import { gapsOf } from "./drops.js";
import { t } from "../words/language.js";

const BY_HAND = t("Kept: this was set by hand.");
const UNKNOWN = t("Kept from the balls that were here: nothing is known of these two.");

/**
 * Return `[drop, notes]` of a drop whose balls were put in another order: contacts and gaps that the catalogue has for the
 * balls before become those that it has for the balls now. What was set by hand stays, and a note says so.
 */
export async function restacked(api, catalogue, before, after) {
  const [old, now] = [await stackOf(api, catalogue, before), await stackOf(api, catalogue, after)];
  const notes = [];
  const gaps = gapsOf(after);
  const contacts = after.contacts.map((contact, i) => {
    const place = before.contacts.indexOf(contact); // of a ball that has come there is none
    const moved = place < 0 || pairOf(before, place) !== pairOf(after, i);
    const isKnown = place < 0 || (old !== null && areAlike(contact, old.drop.contacts[place]));
    if (isKnown && now !== null && (place >= 0 || now.drop.contacts[i].law === contact.law)) {
      if (i > 0 && (place < 1 || gapsOf(before)[place - 1] === old.drop.gaps[place - 1])) gaps[i - 1] = now.drop.gaps[i - 1];
      if (moved) notes[i] = now.contact_sources[i];
      return now.drop.contacts[i];
    }
    if (moved && place >= 0) notes[i] = isKnown ? UNKNOWN : BY_HAND;
    return contact;
  });
  return [{ ...after, contacts, gaps }, notes];
}

/** Return whether a ball is one of the catalogue's, as it is there. */
export function isOfCatalogue(catalogue, { name, mass }) {
  return catalogue.balls.some((ball) => ball.name === name && ball.mass === mass);
}

/** Return the stack that the catalogue has of these balls; null where it does not have all of them. */
async function stackOf(api, catalogue, { balls }) {
  return balls.every((ball) => isOfCatalogue(catalogue, ball)) ? api.stack(balls.map(({ name }) => name), 1) : null;
}

/** Return the balls that make a contact, as a text. */
function pairOf({ balls }, contact) {
  const name = (ball) => balls[ball].name ?? "";
  return contact === 0 ? `floor and ${name(0)}` : [name(contact - 1), name(contact)].sort().join(" and ");
}

/** Return whether two contacts have the same law and numbers. */
function areAlike(one, other) {
  return Object.keys({ ...one, ...other }).every((name) => one[name] === other[name]);
}
