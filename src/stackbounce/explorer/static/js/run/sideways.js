/** How balls leave that do not stand exactly above each other, to first order, as stackbounce/run/sideways.py has it. */

import { InvalidValue } from "../model/errors.js";
import { theEngine } from "../model/one_ball.js";

const MOST = 400; // stretches between events: a run of these takes some 50 ms

/**
 * Return what becomes of each list of offsets in m at the start of a run: `{offset, speed}` of each ball at its end, and how it came
 * there, `path` by ball over `time`.
 */
function carried(result, begun) {
  check(result);
  const { drop, rows, end } = result;
  const { log, events, layout } = theEngine();
  const radii = drop.balls.map(({ diameter }) => 0.5 * diameter);
  const stack = { mass: drop.balls.map(({ mass }) => mass), distance: radii.map((radius, i) => radius + (radii[i - 1] ?? 0)) };
  const struck = rows.filter((row) => row[log.KIND] === events.COLLISION);
  if (struck.length) {
    const force = struck.flatMap((row) => radii.map((_, i) => (i === row[log.CONTACT] ? row[log.IMPULSE] : 0)));
    const pushes = { ...stack, time: struck.map((row) => row[log.TIME]), share: struck.map(() => 1), force };
    return theEngine().lendPushes(radii.length, struck.length, (room) => carry(room, pushes, begun, 1, end).found);
  }
  const { LEVELS, FEW, MANY, ENOUGH, WRONG } = layout.pushes;
  const times = rows.flatMap((row) => [row[log.TIME], row[log.START], row[log.PEAK_TIME]]).filter((time) => time > 0 && time < end);
  const moments = [...new Set([0, ...times])].sort((a, b) => a - b);
  if (moments.length > MOST) throw new InvalidValue(`sideways motion needs a run of at most ${MOST} stretches between events, got ${moments.length}`);
  for (let count = FEW; ; count *= 2) {
    const { found, error } = theEngine().lendPushes(radii.length, count * moments.length, (room) => {
      room.put({ time: moments.flatMap((moment) => [moment, ...new Array(count - 1).fill(0)]) });
      room.call("place_pushes", count, end);
      const { force, compression } = result.again(room.read("time")).samples;
      const isDeep = compression.some((deep, k) => k % radii.length > 0 && deep >= stack.distance[k % radii.length]);
      if (isDeep) throw new InvalidValue("sideways motion needs centres that stay apart");
      return carry(room, { ...stack, force, compression }, begun, LEVELS, end);
    });
    const most = Math.max(...found.flatMap(({ speed }) => speed.map(Math.abs)));
    const isLast = count * moments.length >= MANY;
    if (isLast && error > WRONG * most) throw new InvalidValue("sideways motion grows too fast in this run to be followed");
    if (isLast || error <= ENOUGH * most) return found;
  }
}

/** Raise what a run lacks that sideways motion needs. */
function check({ drop, run, status }) {
  const bare = drop.balls.findIndex(({ diameter }) => diameter === undefined);
  if (bare >= 0) throw new InvalidValue(`sideways motion needs each ball's diameter: ball ${bare} has none`);
  const ended = ["FINISHED", "TIME_REACHED"].includes(status);
  const why = run.infinite.some(Boolean) ? "had infinitely many collisions" : ended ? null : `is ${status}`;
  if (why) throw new InvalidValue(`sideways motion needs all impulses of a run: this one ${why}`);
}

/** Return what was found of each list of offsets, and the error of the speeds. */
function carry(room, pushes, begun, levels, end) {
  const count = pushes.mass.length;
  let error = 0;
  const found = begun.map((offsets) => {
    room.put({ ...pushes, begin: offsets });
    room.call("carry_sideways", levels, end);
    const row = (level) => [...room.read("end").slice(2 * count * level, 2 * count * (level + 1))];
    const last = row(levels - 1);
    const [offset, speed] = [last.slice(0, count), last.slice(count)];
    if (levels > 1) row(levels - 2).slice(count).forEach((coarse, ball) => (error = Math.max(error, Math.abs(speed[ball] - coarse))));
    const path = room.read("path");
    const along = (ball) => Array.from({ length: path.length / count }, (_, k) => path[k * count + ball]);
    return { offset, speed, time: [...room.read("time"), end], path: offset.map((at, ball) => [...along(ball), at]) };
  });
  return { found, error };
}

/** Return how balls leave for each list of offsets: `{offset, speed, angle, landing}` in SI units, and `time` and `path` until then. */
export function leaveSideways(result, begun) {
  const { position } = result.sample([result.end]);
  const { pull } = result.drop;
  const down = result.speeds.map((speed, ball) => (speed + Math.sqrt(speed * speed + 2 * pull * position[ball][0])) / pull);
  return carried(result, begun).map(({ offset, speed, ...way }) => {
    const angle = speed.map((sideways, ball) => Math.atan2(sideways, Math.abs(result.speeds[ball])));
    return { offset, speed, angle, landing: offset.map((at, ball) => (down[ball] >= 0 ? at + down[ball] * speed[ball] : NaN)), ...way };
  });
}
