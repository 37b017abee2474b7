/** A record laid over a simulated drop: the same clock, the same zero of height, the same unit. */

import { extentOf } from "../../extent.js";
import { GRAVITY } from "../../set_up/drops.js";
import { t, translated } from "../../words/language.js";

const TRIES = 160; // shifts of the clock that are tried
const FALLING = 60; // points of the fall before the impact

/** Return the curves `[{label, what, index, unit, time, values}]` of a file that a drop has too, on its clock. */
export function laid({ series, zero }, drop) {
  return series
    .filter(({ what, index }) => what !== "other" && index < drop.balls.length)
    .map((curve) => ({ ...curve, time: curve.time.map((time) => time - (zero ?? 0)) }));
}

/** Return curves later by a shift in s. */
export function shifted(curves, shift) {
  if (shift === 0) return curves;
  return curves.map((curve) => ({ ...curve, time: curve.time.map((time) => time + shift) }));
}

/** Return the simulated lines `[{index, time, values}]` of a result that belong to curves. */
export function lines({ frames, drop }, curves) {
  return curves.map(({ what, index }) => {
    const values = frames[what][index];
    if (what !== "position") return { index, time: frames.time, values };
    const fall = falling(frames.time[0], values[0], frames.velocity[index][0], drop.gravity || GRAVITY);
    return { index, time: [...fall.time, ...frames.time], values: [...fall.values, ...values] };
  });
}

/** Return the positions of a ball before the impact: a fall from rest. */
function falling(end, place, velocity, gravity) {
  const lasts = Math.max(-velocity / gravity, 0);
  const steps = Array.from({ length: FALLING }, (_, i) => -lasts * (1 - i / FALLING));
  return {
    time: steps.map((step) => end + step),
    values: steps.map((step) => place + velocity * step - (gravity * step * step) / 2),
  };
}

/**
 * Return curves in the unit and from the zero of the simulated lines: a voltage gets the scale at
 * which the peaks agree, and a track, which follows some point of its ball, is moved up or down.
 */
export function matched(curves, simulated) {
  const notes = [];
  const found = curves.map((curve, i) => {
    const line = simulated[i];
    if (curve.what === "force" && curve.unit !== "N") {
      const scale = most(line.values) / (most(curve.values) || 1);
      const values = { what: translated(curve.label), unit: curve.unit || t("no unit") };
      notes.push(t("{what} is in {unit}: its scale is chosen so that its peak is the simulated one.", values));
      return { ...curve, unit: "N", values: curve.values.map((value) => value * scale) };
    }
    if (curve.what !== "position") return curve;
    const offset = mean(differences(curve, line, 0));
    if (!Number.isFinite(offset)) return curve;
    const values = { what: translated(curve.label), size: (Math.abs(offset) * 1e3).toFixed(0) };
    const lower = t("{what} is drawn {size} mm lower than tracked, to lie on the simulated ball.", values);
    const higher = t("{what} is drawn {size} mm higher than tracked, to lie on the simulated ball.", values);
    if (Math.abs(offset) > 5e-4) notes.push(offset > 0 ? lower : higher);
    return { ...curve, values: curve.values.map((value) => value - offset) };
  });
  return { curves: found, notes };
}

/**
 * Return the shift of the clock in s, within a reach, at which tracks lie best on simulated lines. They are
 * compared until a time, as later on they go apart if the drop is not yet the right one.
 */
export function bestShift(curves, simulated, reach, until) {
  const cost = (shift) => shifted(curves, shift).reduce((sum, curve, i) => sum + distance(curve, simulated[i], until), 0);
  let [best, least] = [0, Infinity];
  for (let wide = reach, middle = 0; wide > reach / 1000; wide /= 20, middle = best) {
    for (let i = -TRIES / 4; i <= TRIES / 4; i += 1) {
      const shift = middle + (wide * i * 4) / TRIES;
      const now = cost(shift);
      if (now < least) [best, least] = [shift, now];
    }
  }
  return best;
}

/** Return how far a track is from a line, but for its zero. */
function distance(curve, line, until) {
  const apart = differences(curve, line, until);
  const middle = mean(differences(curve, line, 0));
  return apart.length ? apart.reduce((sum, difference) => sum + (difference - middle) ** 2, 0) / apart.length ** 2 : Infinity; // a few points lie on it by chance
}

/** Return curve minus line, until a time, wherever the line is. */
function differences({ time, values }, line, until) {
  const found = [];
  let place = 0;
  time.forEach((now, i) => {
    if (values[i] === null || now > until) return;
    while (place + 2 < line.time.length && line.time[place + 1] < now) place += 1;
    const [from, to] = [line.time[place], line.time[place + 1]];
    if (now < line.time[0] || now > line.time.at(-1)) return;
    const part = to > from ? (now - from) / (to - from) : 0;
    found.push(values[i] - (line.values[place] + part * (line.values[place + 1] - line.values[place])));
  });
  return found;
}

function mean(values) {
  return values.reduce((sum, value) => sum + value, 0) / values.length;
}

function most(values) {
  return extentOf([0, ...values])[1];
}
