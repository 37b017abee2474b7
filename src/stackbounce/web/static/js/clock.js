/** The clock that stage and plots follow: one time, one rate, one loop. */

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

export class Clock {
  /** @param {() => boolean} calm whether the clock jumps from stop to stop instead of running */
  constructor(calm = () => false) {
    this.calm = calm;
    this.time = 0;
    this.begin = 0;
    this.end = 1;
    this.rate = 1e-3; // seconds shown in a second
    this.stops = [];
    this.playing = false;
    this.listeners = new Set();
    this.asked = 0;
    this.last = null;
  }

  /** Call a listener with the clock whenever its time or its playing has changed. */
  subscribe(listener) {
    this.listeners.add(listener);
  }

  /** Set the window of time, and the stops of a calm clock. */
  span(begin, end, stops) {
    Object.assign(this, { begin, end, stops });
    this.time = Math.min(Math.max(this.time, begin), end);
    this.touch();
  }

  seek(time) {
    this.time = Math.min(Math.max(time, this.begin), this.end);
    this.touch();
  }

  play() {
    if (this.playing) return;
    const rest = this.end - this.time;
    if (rest <= 1e-6 * (this.end - this.begin)) this.time = this.begin;
    this.playing = true;
    this.last = null;
    this.touch();
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.touch();
  }

  /** Ask for one frame; however often it is asked, there is one. */
  touch() {
    this.asked ||= requestAnimationFrame((now) => this.frame(now));
  }

  frame(now) {
    this.asked = 0;
    if (this.playing) this.advance(now);
    for (const listener of this.listeners) listener(this);
    if (this.playing) this.touch();
  }

  advance(now) {
    this.last ??= now;
    const passed = now - this.last;
    if (this.calm()) {
      if (passed < JUMP) return;
      this.time = this.stops.find((stop) => stop > this.time + 1e-12) ?? this.end;
    } else {
      // A tab that was hidden goes on where it was.
      this.time += this.rate * 1e-3 * Math.min(passed, 100);
    }
    this.last = now;
    if (this.time < this.end) return;
    this.time = this.end;
    this.playing = false;
  }
}
