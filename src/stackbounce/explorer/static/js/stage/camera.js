/** The camera of a film: near while balls touch, far in fall and leap, and never so near that a ball leaves the picture. */

import { pieceAt } from "./film.js";
import { bisected, clamp, closeUp, farView, highest, largest, radii, stacked } from "./shape.js";

const SAMPLES = 240; // of a film, at which is looked how near the camera may be
const LEAST = 20; // px of height, so that a scale is positive however small the stage is
const SMOOTH = 0.25; // s of film to either side
const ZOOMS = { before: (part) => smooth(part), impact: () => 1, between: () => 1, after: (part) => 1 - smooth(part) };

/**
 * Return the camera of a film in a picture of `width` and `height` px: `at(time)` is the view, `{scale, move, radius, rest,
 * lift, near}`, with lengths in px; `near` is 1 at the impact and 0 far away. `also` is another film that must be seen.
 */
export function cameraOf(film, result, { width, height: room, magnify, also = null, least = 0 }) {
  const height = Math.max(room, LEAST);
  const radius = radii(result.drop);
  const sinks = (position) => (film.floor ? 0 : Math.max(0, -position[0])); // m below the place on the floor
  const far = farView(radius, { width, height, ...reach(film, result, also, least) });
  const near = film.whole ? far : closeUp(result, { width, height, asked: magnify });
  const view = (zoom) => {
    const scale = far.scale ** (1 - zoom) * near.scale ** zoom;
    return { scale, move: far.move ** (1 - zoom) * near.move ** zoom, near: zoom, ...stacked(radius, scale) };
  };
  const needs = ({ rest, radius: drawn, move }, position) => rest.at(-1) + drawn.at(-1) + move * (position.at(-1) + sinks(position));
  const mostAt = (time, position) => {
    const wanted = zoomAt(film, time);
    return needs(view(wanted), position) <= height ? 1 : bisected((zoom) => needs(view(zoom), position) <= height, 0, wanted);
  };
  const most = film.whole ? () => 1 : smoothed(film, (time) => mostAt(time, film.at(time).position));
  return {
    times: near.times,
    far: { ...far, ...stacked(radius, far.scale) },
    at: (time, position) => {
      let found = view(Math.min(zoomAt(film, time), most(film.toFilm(time))));
      if (needs(found, position) > height) found = view(Math.min(found.near, mostAt(time, position)));
      return { ...found, lift: found.move * sinks(position) };
    },
  };
}

/** Return the lowest and the highest place in m, from its own in the stack, that a ball of the film comes to. */
function reach(film, result, also, least) {
  const { start, final } = ends(film);
  const others = also ? Object.values(ends(also)).flat() : [];
  const ghosts = Math.max(0, ...(film.whole ? largest(result.separate?.position ?? []) : film.ghosts?.tops ?? []).map((top) => top?.height ?? top ?? 0));
  const own = film.whole ? largest(result.frames.position) : [...start, ...final, ...others, ...tops(film), ...(also ? tops(also) : [])];
  return { low: Math.min(0, ...final, ...start), high: Math.max(least, highest(Math.max(0, ...own), ghosts)) };
}

function ends(film) {
  return { start: film.at(film.begin).position, final: film.at(film.end).position };
}

function tops({ tops: all }) {
  return all.map((top) => top?.height ?? 0);
}

/** Return how near the camera is at a time, from 0 to 1. */
function zoomAt(film, time) {
  const { phase, from, to } = pieceAt(film, time);
  return ZOOMS[phase]?.((time - from) / (to - from)) ?? 0;
}

function smooth(part) {
  const x = clamp(part, 0, 1);
  return x * x * (3 - 2 * x);
}

/**
 * Return a smooth function of film time that nowhere exceeds a function of the drop's time. It is computed where it is asked
 * for: while numbers change, the film stands at one moment.
 */
function smoothed(film, limit) {
  const beside = Math.ceil((SMOOTH * SAMPLES) / film.length);
  const around = (values, i) => {
    const [from, to] = [Math.max(0, i - beside), Math.min(SAMPLES, i + beside)];
    return Array.from({ length: to - from + 1 }, (_, k) => values(from + k));
  };
  const limits = kept((i) => limit(film.toTime((film.length * i) / SAMPLES)));
  const least = kept((i) => Math.min(...around(limits, i)));
  const mean = kept((i) => around(least, i).reduce((sum, one, _at, all) => sum + one / all.length, 0));
  return (reel) => {
    const place = (SAMPLES * reel) / film.length;
    const i = Math.min(Math.floor(place), SAMPLES - 1);
    return mean(i) + (place - i) * (mean(i + 1) - mean(i));
  };
}

/** Return a function of a whole number that computes each value once. */
function kept(compute) {
  const known = [];
  return (i) => (known[i] ??= compute(i));
}
