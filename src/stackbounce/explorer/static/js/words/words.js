/** What balls, contacts and numbers are called on screen. */

import { t, translated } from "./language.js";
import { fixed, format } from "./units.js";

/** Return a ball's name, or its place. */
export function ballName(drop, ball) {
  const { name } = drop.balls[ball] ?? {};
  return name ? translated(name) : t("ball {place}", { place: ball });
}

/** Return what a contact lies between, such as "floor – tennis". */
export function contactName(drop, contact) {
  const lower = contact === 0 ? t("floor") : ballName(drop, contact - 1);
  return `${lower} – ${ballName(drop, contact)}`;
}

/** Return a ball's name as short as a legend of many needs it: its place, whose colour stands beside it. */
export function shortBall(drop, ball) {
  return drop.balls.length > 4 ? String(ball) : ballName(drop, ball);
}

/** Return a contact's name, short where there are many. */
export function shortContact(drop, contact) {
  if (drop.balls.length <= 3) return contactName(drop, contact);
  return contact === 0 ? t("floor–0") : `${contact - 1}–${contact}`;
}

/** Return how often a contact met. */
export function count(collisions) {
  return collisions < 0 ? t("infinitely many") : String(collisions);
}

/** Return a height in mm or m, whichever reads better; a ball that goes down has none. */
export function height(value) {
  if (value === null || value === undefined) return "–";
  return value <= 0 ? "0 m" : metres(value);
}

/** Return a length in mm or m, whichever reads better. */
export function metres(value) {
  return value < 0.1 ? `${format(value * 1e3, 3)} mm` : `${format(value, 3)} m`;
}

/** Return a time of the clock: ms of an impact, s of a whole drop. */
export function moment(time, whole) {
  return whole ? `${fixed(time, 2)} s` : `${fixed(time * 1e3, 1)} ms`;
}

/** Return how fast a film shows what happens: `slow` times slower than it is. */
export function pace(slow) {
  if (Math.abs(slow - 1) < 0.02) return t("in real time");
  return slow > 1 ? t("slowed {times} times", { times: format(slow, 2) }) : t("{times} times as fast as it is", { times: format(1 / slow, 2) });
}

/** Return what happens at an event of a film. */
export function happening(drop, { what, contact, ball }) {
  if (what === "begin") return t("the beginning");
  if (what === "end") return t("the end of the film");
  if (what === "top") return t("top of {ball}", { ball: ballName(drop, ball) });
  const values = { contact: contactName(drop, contact) };
  return what === "touch" ? t("{contact} touch", values) : t("{contact} part", values);
}

/** Return a share of the energy as percent. */
export function percent(share) {
  if (share === null || share === undefined || !Number.isFinite(share)) return "–";
  return `${format(share * 100, 3)} %`;
}

/** Return what was dropped, for paper: balls and contacts from the floor up. */
export function setUp(drop) {
  const parts = drop.balls.map((ball, i) => {
    const { law, ...numbers } = drop.contacts[i];
    const given = Object.entries(numbers).map(([name, value]) => `${translated(name.replaceAll("_", " "))} ${typeof value === "number" ? format(value) : value}`);
    const gap = i > 0 && drop.gaps?.[i - 1] ? t(", gap {gap} mm", { gap: format(drop.gaps[i - 1] * 1e3) }) : "";
    return `${law === "none" ? t("no floor") : `${lawName(law)} (${given.join(", ")})${gap}`}; ${ballName(drop, i)} ${format(ball.mass * 1e3)} g`;
  });
  return t("{parts}; in SI units from the floor up.", { parts: parts.join("; ") });
}

/** Return how high a path comes once the floor has been touched. */
export function highest(times, path) {
  return path.reduce((most, value, i) => (times[i] > 0 ? Math.max(most, value) : most), 0);
}

/** Return the name of a law in words. */
export function lawName(law) {
  return translated(law.replace(/([a-z])([A-Z])/g, "$1 $2"));
}

/** Return a text with a capital first letter. */
export function capital(text) {
  return text ? text[0].toUpperCase() + text.slice(1) : "";
}
