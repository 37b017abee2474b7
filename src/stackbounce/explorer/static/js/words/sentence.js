/** What happened in a drop, what the textbook says, and why they differ: in sentences that are true for every drop. */

import { partsOf, put, write } from "../dom.js";
import { isTranslated, t, translated } from "./language.js";
import { capital, fixed, format, highest, metres } from "./words.js";

const SAME = 0.005; // part of the larger of two speeds by which they may differ and still be called the same
const NEARLY = 0.1;
const MUCH = 1.5; // times as fast, from which on it is told how many times
const NOTHING = 5e-4; // a rebound ratio that is none
const ENDED = ["FINISHED", "COLLAPSED", "SETTLED"];
const SETTLED = 700; // ms without a new result before it is said
const WITH_BALL = new Set(["tennis", "table tennis", "golf"]);

/** Return `{lead, more}`: one sentence on the highest ball, and what is to be said beside it; `brief`: on no other ball. */
export function storyOf(result, until = null, brief = false) {
  const { drop, status, advice } = result;
  if (until !== null) return wholeOutcome(result, until);
  if (!ENDED.includes(status)) {
    return { lead: t("The film ends before the balls have parted, so that their last speeds are not known."), more: `${capital(translated(advice))}.` };
  }
  const top = drop.balls.length - 1;
  if (!result.intervals.length) return { lead: t("Nothing touches, so that no speed changes."), more: "" };
  if (status === "SETTLED") {
    const one = { ball: capital(called(drop, 0)) };
    return { lead: top ? t("The balls come to rest and do not bounce.") : t("{ball} comes to rest and does not bounce.", one), more: "" };
  }
  const own = result.rebound_ratios;
  const theirs = textbookOf(result);
  const how = motion(drop, top, own[top]);
  const lead = theirs && top > 0 ? `${how}, ${compared(own[top], theirs[top])}.` : `${how}.`;
  return { lead, more: more(result, own, theirs, top, brief) };
}

/** Return what a ball is called within a sentence: "the tennis ball", "B1", "the lower ball". */
function called(drop, ball) {
  const name = drop.balls[ball].name;
  const count = drop.balls.length;
  if (!name) {
    if (count === 1) return t("the ball");
    if (ball === count - 1) return count === 2 ? t("the upper ball") : t("the highest ball");
    if (ball === 0) return count === 2 ? t("the lower ball") : t("the lowest ball");
    return t("ball {place} from below", { place: ball + 1 });
  }
  const said = WITH_BALL.has(name) ? `the ${name} ball` : /^\p{Ll}[\p{Ll} -]*$/u.test(name) ? `the ${name}` : name;
  return isTranslated(said) ? translated(said) : name;
}

function wholeOutcome({ drop, frames }, until) {
  const top = drop.balls.length - 1;
  const reached = highest(frames.time, frames.position[top]);
  const values = { ball: capital(called(drop, top)), height: metres(reached), time: format(until) };
  const rises = t("{ball} rises to {height} above where it lay within {time} s.", values);
  return { lead: reached > 0 ? rises : t("{ball} does not rise above where it lay within {time} s.", values), more: "" };
}

function textbookOf({ separate }) {
  return separate && !separate.error && separate.rebound_ratios.every((ratio) => ratio !== null) ? separate.rebound_ratios : null;
}

/** Return a sentence without its end: how a ball moves after the impact, in terms of the speed of the impact. */
function motion(drop, ball, ratio) {
  const values = { ball: capital(called(drop, ball)), times: factor(ratio) };
  if (Math.abs(ratio) < NOTHING) return t("{ball} stands still after the impact", values);
  const alike = Math.abs(Math.abs(ratio) - 1) <= 0.005;
  if (ratio > 0) {
    return alike ? t("{ball} flies up as fast as the drop came in", values) : t("{ball} flies up at {times} times the speed of the impact", values);
  }
  return alike ? t("{ball} goes down as fast as the drop came in", values) : t("{ball} goes down at {times} times the speed of the impact", values);
}

/** Return how a rebound ratio compares with the textbook's. */
function compared(own, theirs) {
  const value = theirs < -NOTHING ? t("{times} times, downwards", { times: factor(theirs) }) : factor(theirs);
  const apart = Math.abs(own - theirs);
  const larger = Math.max(Math.abs(own), Math.abs(theirs));
  if (apart <= NOTHING || apart <= SAME * larger || factor(own) === factor(theirs)) return t("as the textbook says");
  if (apart <= NEARLY * larger) return t("nearly the textbook’s {value}", { value });
  if (Math.abs(theirs) < NOTHING) return t("where the textbook has it stand still");
  if (Math.abs(own) < NOTHING || own * theirs < 0) return t("unlike the textbook’s {value}", { value });
  const times = own / theirs;
  const much = { value, times: times >= 10 ? format(times, 2) : fixed(times, 1) };
  if (times >= MUCH) return t("{times} times as fast as the textbook’s {value}", much);
  return times > 1 ? t("faster than the textbook’s {value}", { value }) : t("slower than the textbook’s {value}", { value });
}

function factor(ratio) {
  return Math.abs(ratio) >= 0.01 ? fixed(Math.abs(ratio), 2) : format(Math.abs(ratio), 2);
}

/** Return the sentences on the other balls and on the reason. */
function more(result, own, theirs, top, brief) {
  const { drop, separate } = result;
  if (top === 0) return "";
  if (!separate) return t("These are the textbook’s collisions: one after the other, each in no time.");
  if (!theirs) return separate.error ? t("The textbook’s way has no answer here: {reason}.", { reason: translated(separate.error) }) : "";
  const apart = own.map((ratio, ball) => Math.abs(ratio - theirs[ball]));
  const differs = (ball) => apart[ball] > Math.max(NOTHING, SAME * Math.max(Math.abs(own[ball]), Math.abs(theirs[ball])));
  const other = apart.reduce((most, one, ball) => (ball !== top && (most < 0 || one > apart[most]) ? ball : most), -1);
  const shown = differs(other) ? `${motion(drop, other, own[other])}, ${compared(own[other], theirs[other])}. ` : "";
  return `${brief ? "" : shown}${reason(drop, arePressedTogether(result), shown !== "" || differs(top))}`;
}

function reason({ balls }, together, differs) {
  const two = balls.length === 2;
  if (differs && together) {
    return two
      ? t("The textbook lets the balls collide one after the other; here both contacts push at the same time.")
      : t("The textbook lets the balls collide one after the other; here several contacts push at the same time.");
  }
  if (differs) return t("The textbook lets the balls collide one after the other, each time at once; here each contact takes time.");
  if (!together) return t("The contacts come one after the other, as in the textbook.");
  return two
    ? t("The textbook’s collisions come one after the other; here both contacts push at the same time, and yet it comes out alike.")
    : t("The textbook’s collisions come one after the other; here several contacts push at the same time, and yet it comes out alike.");
}

/** Return whether two contacts are closed at the same time. */
function arePressedTogether({ intervals }) {
  return intervals.some((interval, i) =>
    intervals.slice(i + 1).some((other) => other.contact !== interval.contact && Math.min(interval.end, other.end) > Math.max(interval.start, other.start)),
  );
}

/** Write what happened into `root`, and into `live`; before a guess, the question. */
export function mountSentence(root, live, store) {
  const { lead, more } = partsOf(root);
  let timer = 0;
  const show = () => {
    const { result, until, predict, guess, closer } = store.get();
    if (!result) return;
    const asked = predict && until === null;
    const story = storyOf(result, until, !closer);
    const said = !asked ? story : guess === null ? question(result) : { ...story, lead: rise(result) ?? story.lead };
    const about = asked && Number.isFinite(guess) ? `${judged(result, guess)} ` : "";
    write(lead, said.lead);
    write(more, `${about}${said.more}`);
    put(root, "class", asked && guess === null ? "sentence asks" : "sentence");
    clearTimeout(timer);
    timer = setTimeout(() => write(live, `${said.lead} ${about}${said.more}`), SETTLED);
  };
  store.watch(["result", "predict", "guess", "closer"], show);
}

function question({ drop }) {
  const name = called(drop, drop.balls.length - 1);
  return { lead: t("How high will {ball} fly?", { ball: name }), more: t("Drag the mark to where you think it goes, if you like, then drop the balls.") };
}

/** Return how high the highest ball rises, and by the textbook would; null if it does not. */
function rise({ drop, rebound_heights: heights, separate }) {
  const top = drop.balls.length - 1;
  if (!(heights[top] > 0)) return null;
  const theirs = separate?.rebound_heights?.[top];
  const values = { ball: capital(called(drop, top)), height: metres(heights[top]), theirs: metres(Math.max(theirs, 0)) };
  return Number.isFinite(theirs) && top > 0 ? t("{ball} rises {height}; the textbook says {theirs}.", values) : t("{ball} rises {height}.", values);
}

/** Return how far off a guess in m was. */
function judged(result, guess) {
  const { drop, rebound_heights: heights } = result;
  const top = drop.balls.length - 1;
  const reached = Math.max(0, heights[top] ?? 0);
  const off = guess - reached;
  const values = { guess: metres(guess), ball: called(drop, top), height: metres(reached), apart: metres(Math.abs(off)) };
  if (Math.abs(off) < 0.005) return t("You thought {guess}; {ball} rises {height}: just there.", values);
  if (off > 0) return t("You thought {guess}; {ball} rises {height}: {apart} too high.", values);
  return t("You thought {guess}; {ball} rises {height}: {apart} too low.", values);
}
