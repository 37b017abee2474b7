/** The clock that stage and plots follow: one time, one film, one loop. */

import { safely } from "../failure.js";

/** Return where a time lies in an ascending list: the index below it and the fraction to the next. */
export function locate(times, time) {
  const last = times.length - 1;
  if (last < 1 || time <= times[0]) return { index: 0, fraction: 0 };
  if (time >= times[last]) return { index: last - 1, fraction: 1 };
  let low = 0;
  let high = last;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return { index: low, fraction: (time - times[low]) / (times[low + 1] - times[low]) };
}

/** Return a list's value at a place that `locate` found. */
export function between(values, { index, fraction }) {
  if (values.length < 2 || fraction === 0) return values[index];
  return values[index] + fraction * (values[index + 1] - values[index]);
}

const JUMP = 900; // ms between two stops where motion is reduced
const LINGER = 1200; // ms at the end of a film that is repeated
const READABLE = 100; // ms that a number stands while a film plays: nobody reads sixty in a second
const LONGEST = 100; // ms of one frame: a tab that was hidden goes on where it was

export class Clock {
  /** @param {() => boolean} calm whether the clock jumps from stop to stop instead of running */
  constructor(calm = () => false) {
    this.calm = calm;
    this.time = 0; // s of the drop
    this.reel = 0; // s of the film
    this.film = null; // {begin, end, length, toFilm, toTime}
    this.speed = 1; // seconds of film shown in a second
    this.loop = false;
    this.stops = [];
    this.playing = false;
    this.listeners = new Set();
    this.asked = 0;
    this.last = null;
    this.legible = true; // whether numbers are written in this frame
    this.written = -Infinity; // ms, when they were
  }

  get begin() {
    return this.film?.begin ?? 0;
  }

  get end() {
    return this.film?.end ?? 1;
  }

  /** Call a listener with the clock whenever its time or its playing has changed. */
  subscribe(listener) {
    this.listeners.add(listener);
  }

  /** Show a film at a time of its drop; `stops` are times to step to. */
  show(film, stops, time = this.time) {
    Object.assign(this, { film, stops });
    this.seek(time);
  }

  /** Go to a time of the drop. */
  seek(time) {
    this.time = Math.min(Math.max(time, this.begin), this.end);
    this.reel = this.film?.toFilm(this.time) ?? 0;
    this.touch();
  }

  /** Go to a time of the film. */
  wind(reel) {
    if (!this.film) return;
    this.reel = Math.min(Math.max(reel, 0), this.film.length);
    this.time = this.film.toTime(this.reel);
    this.touch();
  }

  /** Go to the next stop, or to the one before. */
  step(forward) {
    const apart = 1e-9 * (this.end - this.begin);
    const next = forward
      ? this.stops.find((stop) => stop > this.time + apart)
      : this.stops.findLast((stop) => stop < this.time - apart);
    this.seek(next ?? (forward ? this.end : this.begin));
  }

  play() {
    if (this.playing) return;
    if (this.film && this.reel >= this.film.length * (1 - 1e-6)) this.wind(0);
    this.playing = true;
    this.last = null;
    this.touch();
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.touch();
  }

  /** Stop at the beginning of the film. */
  rewind() {
    this.pause();
    this.seek(this.begin);
  }

  /** Play the film from its beginning. */
  replay() {
    this.rewind();
    this.play();
  }

  /** Ask for one frame; however often it is asked, there is one. */
  touch() {
    this.asked ||= requestAnimationFrame((now) => this.frame(now));
  }

  frame(now) {
    this.asked = 0;
    if (this.playing) this.advance(now);
    this.legible = !this.playing || now - this.written >= READABLE;
    if (this.legible) this.written = now;
    for (const listener of this.listeners) safely(listener, this);
    if (this.playing) this.touch();
  }

  advance(now) {
    this.last ??= now;
    const passed = now - this.last;
    const ended = this.time >= this.end;
    if (passed < (ended ? LINGER : this.calm() ? JUMP : 0)) return;
    if (ended) this.wind(0);
    else if (this.calm()) this.step(true);
    else this.wind(this.reel + this.speed * 1e-3 * Math.min(passed, LONGEST));
    this.last = now;
    if (this.time >= this.end && !this.loop) this.playing = false;
  }
}
