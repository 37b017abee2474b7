/** What balls, contacts and numbers are called on screen. */

import { fixed, format } from "./units.js";

/** Return a ball's name, or its place. */
export function ballName(drop, ball) {
  return drop.balls[ball]?.name || `ball ${ball}`;
}

/** Return what a contact lies between, such as "floor – tennis". */
export function contactName(drop, contact) {
  const lower = contact === 0 ? "floor" : ballName(drop, contact - 1);
  return `${lower} – ${ballName(drop, contact)}`;
}

/** Return a ball's name as short as a legend of many needs it: its place, whose colour stands beside it. */
export function shortBall(drop, ball) {
  return drop.balls.length > 3 ? String(ball) : ballName(drop, ball);
}

/** Return a contact's name, short where there are many. */
export function shortContact(drop, contact) {
  if (drop.balls.length <= 3) return contactName(drop, contact);
  return contact === 0 ? "floor–0" : `${contact - 1}–${contact}`;
}

/** Return how often a contact met. */
export function count(collisions) {
  return collisions < 0 ? "infinitely many" : String(collisions);
}

/** Return a height in mm or m, whichever reads better; a ball that goes down has none. */
export function height(value) {
  if (value === null || value === undefined) return "–";
  if (value <= 0) return "0 m";
  return value < 0.1 ? `${format(value * 1e3, 3)} mm` : `${format(value, 3)} m`;
}

/** Return a time of the clock: ms of an impact, s of a whole drop. */
export function moment(time, whole) {
  return whole ? `${fixed(time, 2)} s` : `${fixed(time * 1e3, 2)} ms`;
}

/** Return a share of the energy as percent. */
export function percent(share) {
  if (share === null || share === undefined || !Number.isFinite(share)) return "–";
  return `${format(share * 100, 3)} %`;
}

/** Return a result in one or two sentences, as somebody would tell it. */
export function told(result, until) {
  const { drop } = result;
  const one = (ball) => {
    const ratio = result.rebound_ratios[ball];
    if (ratio === null) return `${ballName(drop, ball)} has no end speed`;
    if (Math.abs(ratio) < 5e-4) return `${ballName(drop, ball)} stands still`;
    const way = ratio > 0 ? "goes up" : "goes on down";
    return `${ballName(drop, ball)} ${way} at ${format(Math.abs(ratio), 3)} times the impact speed`;
  };
  const balls = drop.balls.map((_, ball) => one(ball)).reverse();
  const kept = percent(result.energy_retained);
  const expected = result.status === "FINISHED" || (until !== null && result.status === "TIME_REACHED");
  const end = expected ? "" : ` ${capital(result.advice)}.`;
  const when = until === null ? "the impact" : `${format(until)} seconds`;
  return `After ${when}, ${balls.join("; ")}. Kinetic energy kept: ${kept}.${end}`;
}

/** Return a text with a capital first letter. */
export function capital(text) {
  return text ? text[0].toUpperCase() + text.slice(1) : "";
}
