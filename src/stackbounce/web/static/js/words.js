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

/** Return what was dropped, for paper: balls and contacts from the floor up. */
export function setUp(drop) {
  const parts = drop.balls.map((ball, i) => {
    const { law, ...numbers } = drop.contacts[i];
    const given = Object.entries(numbers).map(([name, value]) => `${name.replaceAll("_", " ")} ${typeof value === "number" ? format(value) : value}`);
    const gap = i > 0 && drop.gaps?.[i - 1] ? `, gap ${format(drop.gaps[i - 1] * 1e3)} mm` : "";
    return `${law === "none" ? "no floor" : `${law} (${given.join(", ")})${gap}`}; ${ballName(drop, i)} ${format(ball.mass * 1e3)} g`;
  });
  return `${parts.join("; ")}; in SI units from the floor up.`;
}

/** Return a result in one or two sentences, as somebody would tell it. */
export function told(result, until) {
  const { drop } = result;
  const own = until === null ? (ball) => leaving(result, ball) : (ball) => rising(result, ball);
  const balls = drop.balls.map((_, ball) => `${ballName(drop, ball)} ${own(ball)}`).reverse();
  const expected = result.status === "FINISHED" || (until !== null && result.status === "TIME_REACHED");
  const end = expected ? "" : ` ${capital(result.advice)}.`;
  if (until !== null) return `Within ${format(until)} seconds, ${balls.join("; ")}.${end}`;
  return `After the impact, ${balls.join("; ")}. Kinetic energy retained: ${percent(result.energy_retained)}.${end}`;
}

/** Return the upper ball's part of a result, and the textbook's, in a sentence. */
export function shortly(result, until) {
  const { drop, separate } = result;
  const top = drop.balls.length - 1;
  const name = capital(ballName(drop, top));
  if (until !== null || result.rebound_ratios[top] === null) return `${name} ${until === null ? leaving(result, top) : rising(result, top)}.`;
  const own = `${name} ${leaving(result, top)}`;
  if (!separate) return `${own}: these are the textbook’s separate collisions.`;
  if (separate.error || separate.rebound_ratios[top] === null) return `${own}.`;
  const theirs = separate.rebound_ratios[top];
  return `${own}; by the textbook, one collision after the other, it would be ${format(theirs, 3)} times.`;
}

function leaving(result, ball) {
  const ratio = result.rebound_ratios[ball];
  if (ratio === null) return "has no end speed";
  if (Math.abs(ratio) < 5e-4) return "stands still";
  return `goes ${ratio > 0 ? "up" : "on down"} at ${format(Math.abs(ratio), 3)} times the impact speed`;
}

function rising({ frames }, ball) {
  return `rises to ${height(highest(frames.time, frames.position[ball]))}`;
}

/** Return how high a path comes once the floor has been touched. */
export function highest(times, path) {
  return path.reduce((most, value, i) => (times[i] > 0 ? Math.max(most, value) : most), 0);
}

/** Return a text with a capital first letter. */
export function capital(text) {
  return text ? text[0].toUpperCase() + text.slice(1) : "";
}
