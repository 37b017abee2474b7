/** What happened in a drop, what the textbook says, and why they differ: in sentences that are true for every drop. */

import { partsOf, put, write } from "../dom.js";
import { isTranslated, t, translated } from "./language.js";
import { ballName, capital, fixed, format, highest, metres, percent } from "./words.js";

const SAME = 0.005; // part of the larger of two speeds by which they may differ and still be called the same
const NEARLY = 0.1;
const MUCH = 1.5; // times as fast, from which on it is told how many times
const NOTHING = 5e-4; // a rebound ratio that is none
/** How a run ended whose last speeds are known. */
export const ENDED = ["FINISHED", "COLLAPSED", "SETTLED"];

/** The angle in degrees up to which the first order in the offsets is near: an exact angle of 16.5 degrees is 16.1. */
export const FIRST_ORDER = 15;
const NO_ORDER = 45; // degrees, from which on numbers of first order would say nothing
export const ROUGH = t("Above 15° this is a rough estimate: it counts the offset to first order.");
const SETTLED = 700; // ms without a new result before it is said
const WITH_BALL = new Set(["tennis", "table tennis", "golf"]);

/** Return `{lead, more}`: one sentence on the highest ball, and what is to be said beside it; `brief`: on no other ball. */
export function storyOf(result, until = null, brief = false) {
  const { drop, status } = result;
  const isCut = !ENDED.includes(status) && status !== "TIME_REACHED";
  const cut = isCut ? t("The balls meet more often than this page can follow: softer contacts, more loss, or balls of more equal mass make an end.") : "";
  if (until !== null) return { lead: wholeOutcome(result, until), more: cut };
  if (isCut) return { lead: t("The film ends before the balls have parted, so that their last speeds are not known."), more: cut };
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
  const aside = sideways(result, top);
  return { lead, more: [aside, more(result, own, theirs, top, brief || aside !== "")].filter(Boolean).join(" ") };
}

/** Return what a ball is called within a sentence: "the tennis ball", "B1", "the lower ball", "ball 3". */
function called(drop, ball) {
  const name = drop.balls[ball].name;
  const count = drop.balls.length;
  if (!name) {
    if (count === 1) return t("the ball");
    if (count === 2) return ball === 1 ? t("the upper ball") : t("the lower ball");
    return ballName(drop, ball);
  }
  const said = WITH_BALL.has(name) ? `the ${name} ball` : /^\p{Ll}[\p{Ll} -]*$/u.test(name) ? `the ${name}` : name;
  return isTranslated(said) ? translated(said) : name;
}

function wholeOutcome({ drop, frames }, until) {
  const top = drop.balls.length - 1;
  const reached = highest(frames.time, frames.position[top]);
  const values = { ball: capital(called(drop, top)), height: metres(reached), time: format(until) };
  const rises = t("{ball} rises to {height} above where it lay within {time} s.", values);
  return reached > 0 ? rises : t("{ball} does not rise above where it lay within {time} s.", values);
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

/** Return what a ball off the middle does to the highest one; empty without one. */
function sideways({ drop, sideways: found, rebound_speeds: speeds }, top) {
  if (!found) return "";
  if (found.error) return t("Where balls off the middle go is not known here: that takes the size of each ball, and not too many collisions.");
  if (!(speeds[top] > 0)) return "";
  const angle = (Math.abs(found.angle[top]) * 180) / Math.PI;
  if (angle > NO_ORDER) return t("So far off the middle the balls fly apart sideways: first order cannot say how.");
  const values = { ball: called(drop, top), angle: fixed(angle, 1), far: metres(Number(Math.abs(found.landing[top]).toPrecision(2))), offset: metres(drop.balls[top].offset ?? 0) };
  const isAlone = drop.balls.every(({ offset }, ball) => Boolean(offset) === (ball === top));
  const said = isAlone
    ? t("{offset} to the side: {ball} leaves {angle}° off, and lands {far} away.", values)
    : t("With balls off the middle, {ball} leaves {angle}° off, and lands {far} away.", values);
  return angle > FIRST_ORDER ? `${said} ${ROUGH}` : said;
}

function factor(ratio) {
  return Math.abs(ratio) >= 0.01 ? fixed(Math.abs(ratio), 2) : format(Math.abs(ratio), 2);
}

/** Return the sentences on the other balls and on the reason. */
function more(result, own, theirs, top, brief) {
  const { drop, separate } = result;
  if (top === 0) return "";
  if (!separate) return textbooks(result);
  if (!theirs) return separate.error ? t("The textbook’s way has no answer here: {reason}.", { reason: translated(separate.error) }) : "";
  const apart = own.map((ratio, ball) => Math.abs(ratio - theirs[ball]));
  const differs = (ball) => apart[ball] > Math.max(NOTHING, SAME * Math.max(Math.abs(own[ball]), Math.abs(theirs[ball])));
  const other = apart.reduce((most, one, ball) => (ball !== top && (most < 0 || one > apart[most]) ? ball : most), -1);
  const shown = differs(other) ? `${motion(drop, other, own[other])}, ${compared(own[other], theirs[other])}. ` : "";
  return `${brief ? "" : shown}${reason(drop, togetherOf(result), shown !== "" || differs(top))}`;
}

function textbooks({ intervals, status }) {
  const count = intervals.length;
  if (count < 3 || status !== "FINISHED") return t("These are the textbook’s collisions: one after the other, each in no time.");
  return t("These are the textbook’s collisions: {count} of them, one after the other, each in no time.", { count });
}

function reason({ balls }, together, differs) {
  const two = balls.length === 2;
  const values = { share: percent(Number(together.toPrecision(2))) };
  if (together >= NEARLY && differs) {
    return two
      ? t("The textbook lets the balls collide one after the other; here both contacts push at the same time for {share} of the impact.", values)
      : t("The textbook lets the balls collide one after the other; here several contacts push at the same time for {share} of the impact.", values);
  }
  if (together >= NEARLY) {
    return two
      ? t("The textbook’s collisions come one after the other; here both contacts push at the same time for {share} of the impact, and yet it comes out alike.", values)
      : t("The textbook’s collisions come one after the other; here several contacts push at the same time for {share} of the impact, and yet it comes out alike.", values);
  }
  if (differs) return t("The textbook lets the balls collide one after the other, each time at once; here each contact takes time.");
  return together > 0 ? t("The contacts come nearly one after the other, as in the textbook.") : t("The contacts come one after the other, as in the textbook.");
}

/** Return for which share of the time in which contacts are closed two of them are. */
function togetherOf({ intervals }) {
  const turns = intervals.flatMap(({ start, end }) => [[start, 1], [end, -1]]).sort(([a], [b]) => a - b);
  let [closed, together, open, before] = [0, 0, 0, 0];
  for (const [time, step] of turns) {
    if (open > 0) closed += time - before;
    if (open > 1) together += time - before;
    [before, open] = [time, open + step];
  }
  return closed > 0 ? together / closed : 0;
}

/** Write what happened into `root`, and into `live`; before a guess, the question. */
export function mountSentence(root, live, store) {
  const { lead, more } = partsOf(root);
  let timer = 0;
  const show = () => {
    const state = store.get();
    const { result, until, predict, guess } = state;
    if (!result) return;
    const said = saidOf(state);
    const about = predict && until === null && Number.isFinite(guess) ? `${judged(result, guess)} ` : "";
    write(lead, said.lead);
    write(more, `${about}${said.more}`);
    put(root, "class", isAsking(state) ? "sentence asks" : "sentence");
    clearTimeout(timer);
    timer = setTimeout(() => write(live, `${said.lead} ${about}${said.more}`), SETTLED);
  };
  store.watch(["result", "predict", "guess", "closer", "view"], show);
}

/** Return whether a guess is asked for, so that nothing may tell the answer. */
export function isAsking({ until, predict, guess }) {
  return predict && until === null && guess === null;
}

/** Return what is said of a state with a result: the question while a guess is asked for, then the story. */
export function saidOf(state) {
  if (isAsking(state)) return question(state.result);
  const story = storyOf(state.result, state.until, !state.closer);
  return state.view === "play" && state.predict && state.until === null ? { ...story, lead: rise(state.result) ?? story.lead } : story;
}

function question({ drop }) {
  const name = called(drop, drop.balls.length - 1);
  return { lead: t("How high will {ball} fly?", { ball: name }), more: t("Drag the mark to where you think it goes, if you like, then drop the balls.") };
}

/** Return how high the highest ball rises, and by the textbook would; null if it does not. */
function rise({ drop, status, rebound_heights: heights, separate }) {
  const top = drop.balls.length - 1;
  if (!ENDED.includes(status) || !(heights[top] > 0)) return null;
  const theirs = separate?.rebound_heights?.[top];
  const values = { ball: capital(called(drop, top)), height: metres(heights[top]), theirs: metres(Math.max(theirs, 0)) };
  return Number.isFinite(theirs) && top > 0 ? t("{ball} rises {height}; the textbook says {theirs}.", values) : t("{ball} rises {height}.", values);
}

/** Return how far off a guess in m was. */
function judged({ status, rebound_heights: heights }, guess) {
  const off = guess - Math.max(0, heights.at(-1) ?? 0);
  const values = { guess: metres(guess), apart: metres(Math.abs(off)) };
  if (!ENDED.includes(status)) return t("You thought {guess}.", values);
  if (Math.abs(off) < 0.005) return t("You thought {guess}: just there.", values);
  return off > 0 ? t("You thought {guess}: {apart} too high.", values) : t("You thought {guess}: {apart} too low.", values);
}
