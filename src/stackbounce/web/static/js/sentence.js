/** What happened in a drop, what the textbook says, and why they differ: in sentences that are true for every drop. */

import { fixed, format } from "./units.js";
import { capital, highest, metres } from "./words.js";

const SAME = 0.02; // part of the larger of two speeds by which they may differ and still be called the same
const NEARLY = 0.1;
const MUCH = 1.5; // times as fast, from which on it is told how many times
const NOTHING = 5e-4; // a rebound ratio that is none
const ENDED = ["FINISHED", "COLLAPSED", "SETTLED"];
const WITH_BALL = new Set(["tennis", "table tennis", "golf"]);

/** Return `{lead, more}`: one sentence on the highest ball, and what is to be said beside it. */
export function storyOf(result, until = null) {
  const { drop, status, advice } = result;
  if (until !== null) return wholeOutcome(result, until);
  if (!ENDED.includes(status)) {
    return { lead: "The film ends before the balls have parted, so that their last speeds are not known.", more: `${capital(advice)}.` };
  }
  const top = drop.balls.length - 1;
  if (!result.intervals.length) return { lead: "Nothing touches, so that no speed changes.", more: "" };
  if (status === "SETTLED") return { lead: top ? "The balls come to rest and do not bounce." : `${capital(called(drop, 0))} comes to rest and does not bounce.`, more: "" };
  const own = result.rebound_ratios;
  const theirs = textbookOf(result);
  const lead = theirs && top > 0 ? `${motion(drop, top, own[top])}, ${compared(own[top], theirs[top])}.` : `${motion(drop, top, own[top])}.`;
  return { lead, more: more(result, own, theirs, top) };
}

/** Return what a ball is called within a sentence: "the tennis ball", "B1", "the lower ball". */
export function called(drop, ball) {
  const name = drop.balls[ball].name;
  const count = drop.balls.length;
  if (!name) {
    if (count === 1) return "the ball";
    if (ball === count - 1) return count === 2 ? "the upper ball" : "the highest ball";
    if (ball === 0) return count === 2 ? "the lower ball" : "the lowest ball";
    return `ball ${ball + 1} from below`;
  }
  if (WITH_BALL.has(name)) return `the ${name} ball`;
  return /^\p{Ll}[\p{Ll} -]*$/u.test(name) ? `the ${name}` : name;
}

function wholeOutcome({ drop, frames }, until) {
  const top = drop.balls.length - 1;
  const reached = highest(frames.time, frames.position[top]);
  const name = capital(called(drop, top));
  const rise = reached > 0 ? `rises to ${metres(reached)} above where it lay` : "does not rise above where it lay";
  return { lead: `${name} ${rise} within ${format(until)} s.`, more: "" };
}

function textbookOf({ separate }) {
  return separate && !separate.error && separate.rebound_ratios.every((one) => one !== null) ? separate.rebound_ratios : null;
}

/** Return a sentence without its end: how a ball moves after the impact, in terms of the speed of the impact. */
function motion(drop, ball, ratio) {
  const name = capital(called(drop, ball));
  if (Math.abs(ratio) < NOTHING) return `${name} stands still after the impact`;
  const way = ratio > 0 ? "flies up" : "goes down";
  if (Math.abs(Math.abs(ratio) - 1) <= 0.005) return `${name} ${way} as fast as the drop came in`;
  return `${name} ${way} at ${factor(ratio)} times the speed of the impact`;
}

/** Return how a rebound ratio compares with the textbook's. */
function compared(own, theirs) {
  const value = `${factor(theirs)}${theirs < -NOTHING ? " times, downwards" : ""}`;
  const apart = Math.abs(own - theirs);
  const larger = Math.max(Math.abs(own), Math.abs(theirs));
  if (apart <= NOTHING || apart <= SAME * larger) return "as the textbook says";
  if (apart <= NEARLY * larger) return `nearly the textbook’s ${value}`;
  if (Math.abs(theirs) < NOTHING) return "where the textbook has it stand still";
  if (Math.abs(own) < NOTHING || own * theirs < 0) return `unlike the textbook’s ${value}`;
  const times = own / theirs;
  if (times >= MUCH) return `${times >= 10 ? format(times, 2) : fixed(times, 1)} times as fast as the textbook’s ${value}`;
  return times > 1 ? `faster than the textbook’s ${value}` : `slower than the textbook’s ${value}`;
}

function factor(ratio) {
  return Math.abs(ratio) >= 0.01 ? fixed(Math.abs(ratio), 2) : format(Math.abs(ratio), 2);
}

/** Return the sentences on the other balls and on the reason. */
function more(result, own, theirs, top) {
  const { drop, separate } = result;
  if (top === 0) return "";
  if (!separate) return "These are the textbook’s collisions: one after the other, each in no time.";
  if (!theirs) return separate.error ? `The textbook’s way has no answer here: ${separate.error}.` : "";
  const apart = own.map((ratio, ball) => Math.abs(ratio - theirs[ball]));
  const differs = (ball) => apart[ball] > Math.max(NOTHING, SAME * Math.max(Math.abs(own[ball]), Math.abs(theirs[ball])));
  const other = apart.reduce((most, one, ball) => (ball !== top && (most < 0 || one > apart[most]) ? ball : most), -1);
  const shown = differs(other) ? `${motion(drop, other, own[other])}, ${compared(own[other], theirs[other])}. ` : "";
  return `${shown}${reason(drop, arePressedTogether(result), shown !== "" || differs(top))}`;
}

function reason({ balls }, together, differs) {
  const all = balls.length === 2 ? "both contacts push" : "several contacts push";
  if (differs && together) return `The textbook lets the balls collide one after the other; here ${all} at the same time.`;
  if (differs) return "The textbook lets the balls collide one after the other, each time at once; here each contact takes time.";
  return together ? `The textbook’s collisions come one after the other; here ${all} at the same time, and yet it comes out alike.` : "The contacts come one after the other, as in the textbook.";
}

/** Return whether two contacts are closed at the same time. */
function arePressedTogether({ intervals }) {
  return intervals.some((one, i) =>
    intervals.slice(i + 1).some((other) => other.contact !== one.contact && Math.min(one.end, other.end) > Math.max(one.start, other.start)),
  );
}
