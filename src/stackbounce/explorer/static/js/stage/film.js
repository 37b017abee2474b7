/** A drop as a film of at most 15 s: the fall in real time, the impact slowed, the leap in real time. */

import { ghostMotion, motionOf, wholeMotion } from "./motion.js";
import { bisected } from "./shape.js";

const FALL = 2; // s of film, at most
const NEAR = 0.9; // s of film before the first touch and after the last separation, in which the camera moves
const IMPACT = 6; // s of film from the first touch to the last separation
const BETWEEN = 1.2; // s of film that the flights between contacts may have, in slow motion
const MANY = 8; // flights between contacts that take no time, from which on each has as long, so that contacts can be counted
const COUNTED = 0.2; // s of film that each of them has, at most
const SLOWEST = 1e6; // times that such a flight is slowed, at most: those of balls that come to rest pass at once
const COUNTING = 4.7; // s of film that all of them have, at most
const REAL = 1.3; // s of film that the same may have, in real time
const LEAP = 2.8; // s of film up to the highest top, at most
const TOP = 1; // s of film at which it stands there
const STANDS = 2e-3; // s of the drop that pass meanwhile, too little to be seen
const BACK = 1.2; // s of film back from there, at most
const INSTANT = 100; // times that an impact without duration is slowed

/**
 * Return the film of a result. It has `pieces`, `{phase, from, to, start, length}` in drop time and film time in s; the maps
 * `toFilm` and `toTime` between the two; the motion, `at(time)`, and the textbook's, `ghosts`; `slow`, how many times
 * contacts are slowed; `counted`, whether flights between them are, so that all can be counted; `begins`, the times of contacts; and `events`, `{time, what, contact, ball}`, by time.
 */
export function filmOf(result, until = null) {
  const whole = until !== null;
  const motion = whole ? wholeMotion(result) : motionOf(result);
  const { time } = result.frames;
  const { slow, parts, counted = false } = whole ? { slow: 1, parts: [["whole", time[0], time.at(-1), time.at(-1) - time[0]]] } : partsOf(result, motion);
  const pieces = [];
  let length = 0;
  for (const [phase, from, to, lasts] of parts) {
    if (!(to > from && lasts > 0)) continue;
    pieces.push({ phase, from, to, start: length, length: lasts });
    length += lasts;
  }
  const begin = pieces[0].from;
  const end = pieces.at(-1).to;
  const tops = motion.tops.map((top) => (top && top.time > motion.last && top.time <= end ? top : null));
  return {
    ...motion,
    result,
    tops,
    ghosts: ghostMotion(result, whole),
    whole,
    floor: (result.drop.contacts[0]?.law ?? "none") !== "none",
    pieces,
    length,
    begin,
    end,
    slow,
    counted,
    begins: result.intervals.map(({ start }) => start).sort((a, b) => a - b),
    events: eventsOf(result, tops, begin, end),
    toFilm: (value) => {
      const piece = pieces.find(({ to }) => value < to) ?? pieces.at(-1);
      return piece.start + piece.length * part(value, piece.from, piece.to);
    },
    toTime: (value) => {
      const piece = pieces.find(({ start, length: lasts }) => value < start + lasts) ?? pieces.at(-1);
      return piece.from + (piece.to - piece.from) * part(value, piece.start, piece.start + piece.length);
    },
  };
}

/** Return the piece of a film that is shown at a time: its phase is fall, before, impact, between, after, leap, top, back or whole. */
export function pieceAt({ pieces }, time) {
  return pieces.find(({ to }) => time < to) ?? pieces.at(-1);
}

/** Return the time of a film at the moment that an older film shows at a time: the same part of fall or leap. */
export function sameMoment(old, time, film) {
  if (time >= old.end - 1e-9 * (old.end - old.begin)) return film.end;
  if (time < 0) return film.begin * part(time, 0, old.begin);
  if (time <= old.last) return Math.min(time, film.last);
  return film.last + (film.end - film.last) * part(time, old.last, old.end);
}

function part(value, low, high) {
  return high === low ? 0 : Math.min(Math.max((value - low) / (high - low), 0), 1);
}

/** Return how many times contacts are slowed, and the parts of the film as [phase, from, to, film length]. */
function partsOf({ intervals }, { fall, last, rise, leap }) {
  const up = rise ?? leap;
  const [top, end] = [last + up, last + leap];
  const back = Math.min(top + STANDS, end);
  const leapFrom = (after) => [
    ["leap", last + after, top, Math.min(up - after, LEAP)],
    ["top", top, back, TOP],
    ["back", back, end, Math.min(end - back, BACK)],
  ];
  const spans = contactSpans(intervals, last);
  if (!intervals.length || (!spans.length && !fall && !leap)) {
    const still = fall || leap ? [] : [["leap", 0, Math.max(last, 1e-3), 1]];
    return { slow: 1, parts: [["fall", -fall, 0, Math.min(fall, FALL)], ...leapFrom(0), ...still] };
  }
  const closed = total(spans.filter((span) => span.closed));
  const open = spans.filter((span) => !span.closed);
  const flown = total(open);
  const counted = closed === 0 && open.length >= MANY;
  const between = counted ? Math.min(COUNTED * open.length, COUNTING) : BETWEEN;
  const lasts = ({ from, to, closed: isClosed }, slow) => {
    const most = Math.max(between / open.length, Math.min(1, REAL / flown) * (to - from));
    return isClosed ? slow * (to - from) : Math.min((counted ? SLOWEST : slow) * (to - from), most);
  };
  const length = (slow) => spans.reduce((sum, span) => sum + lasts(span, slow), 0);
  const slow = closed > 0 ? Number(Math.max(bisected((times) => length(times) < IMPACT, 0, IMPACT / closed), 1).toPrecision(2)) : INSTANT;
  const before = Math.min(NEAR / slow, 0.5 * fall);
  const after = Math.min(NEAR / slow, 0.5 * up);
  const parts = [
    ["fall", -fall, -before, Math.min(fall - before, FALL)],
    ["before", -before, 0, slow * before],
    ...spans.map((span) => [span.closed ? "impact" : "between", span.from, span.to, lasts(span, slow)]),
    ["after", last, last + after, slow * after],
    ...leapFrom(after),
  ];
  return { slow, parts, counted };
}

/** Return the time from the first touch to the last separation as spans, `{from, to, closed}`: some contact is closed, or none. */
function contactSpans(intervals, last) {
  const spans = [];
  let reached = 0;
  const add = (to, closed) => {
    if (to > reached) spans.push({ from: reached, to, closed });
    reached = Math.max(reached, to);
  };
  for (const { start, end } of intervals) {
    add(Math.min(start, last), false);
    add(Math.min(end ?? last, last), true);
  }
  add(last, false);
  return spans;
}

function total(spans) {
  return spans.reduce((sum, { from, to }) => sum + to - from, 0);
}

/** Return what happens, by time: begin, touch, parting, top, end. */
function eventsOf({ intervals }, tops, begin, end) {
  const events = [{ time: begin, what: "begin" }, { time: end, what: "end" }];
  for (const { contact, start, end: parted } of intervals) {
    events.push({ time: start, what: "touch", contact });
    if (parted !== null && parted > start) events.push({ time: parted, what: "parting", contact });
  }
  tops.forEach((top, ball) => top && events.push({ time: top.time, what: "top", ball }));
  return events.filter(({ time }) => time >= begin && time <= end).sort((a, b) => a.time - b.time);
}
