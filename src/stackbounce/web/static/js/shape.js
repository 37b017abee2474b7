/** Where balls are drawn and how they flatten: plain geometry in pixels. */

const DENSITY = 1000; // kg/m³ of a ball of unknown size, for its picture only
const MOST_FLAT = 0.85; // most flattening of a side, as a fraction of the radius
const MAGNIFICATIONS = [1, 1.5, 2, 3, 5, 8, 10, 15, 20, 30, 50];
const LEAST_RADIUS = 5; // px, so that every ball can be seen

/** Return each ball's radius in m, of a sphere of its mass where no diameter is given. */
export function radii(drop) {
  return drop.balls.map(({ mass, diameter }) =>
    diameter ? diameter / 2 : Math.cbrt((3 * mass) / (4 * Math.PI * DENSITY)),
  );
}

/** Return the largest value of each list. */
function largest(lists) {
  return lists.map((values) => values.reduce((most, value) => Math.max(most, value), 0));
}

/** Return the radius of the smaller ball of a contact. */
function smaller(radius, contact) {
  return contact === 0 ? radius[0] : Math.min(radius[contact - 1], radius[contact]);
}

/** Return how many times movement is shown larger: what was asked for, as far as balls can give way. */
export function magnification(result, asked) {
  const radius = radii(result.drop);
  const compression = largest(result.frames.compression);
  const rooms = compression.map((c, i) => {
    if (c <= 0) return Infinity;
    return (smaller(radius, i) * (i === 0 ? MOST_FLAT : 2 * MOST_FLAT)) / c;
  });
  const room = Math.min(...rooms);
  if (asked !== null) return Math.min(asked, room);
  const third = Math.min(...compression.map((c, i) => (c > 0 ? smaller(radius, i) / 3 / c : Infinity)));
  const nice = MAGNIFICATIONS.filter((one) => one <= third).at(-1) ?? 1;
  return Number.isFinite(third) ? Math.min(nice, room) : 1;
}

const BEYOND = 1.3; // times the balls' own height that is shown for the textbook's to be seen

/** Return the height in m that a whole drop needs: the balls' own, and not too far beyond the textbook's. */
function highest({ separate }, tops) {
  const own = Math.max(...tops);
  const theirs = Math.max(0, ...largest(separate?.position ?? []));
  return Math.max(own, Math.min(theirs, BEYOND * own));
}

/** Return how metres become pixels: radii, rest places, and pixels per metre of movement. */
export function camera(result, { width, height, whole, asked }) {
  const radius = radii(result.drop);
  const stack = 2 * radius.reduce((sum, r) => sum + r, 0);
  const tops = largest(result.frames.position);
  const wide = Math.min(0.44 * width, width - 210) / (2 * Math.max(...radius));
  const times = whole ? 1 : magnification(result, asked);
  const high = stack + times * tops.at(-1);
  const seen = whole ? stack + highest(result, tops) : clamp(high, 1.15 * stack, 1.7 * stack);
  const scale = Math.min(height / seen, wide);
  const drawn = radius.map((r) => Math.max(LEAST_RADIUS, r * scale));
  let below = 0;
  const rest = drawn.map((r) => {
    below += 2 * r;
    return below - r;
  });
  const free = height - below;
  const move = whole ? Math.max(free, 0.3 * height) / Math.max(seen - stack, 1e-9) : scale * times;
  return { radius: drawn, rest, move: whole ? Math.min(move, height / seen) : move, times, scale };
}

/** Return how far each ball's lower and upper side give way, in px. */
export function flattening(compressions, { move, radius }) {
  const last = radius.length - 1;
  return radius.map((r, ball) => {
    const below = Math.max(0, compressions[ball]) * move * (ball === 0 ? 1 : 0.5);
    const above = ball < last ? Math.max(0, compressions[ball + 1]) * move * 0.5 : 0;
    return { lower: Math.min(below, MOST_FLAT * r), upper: Math.min(above, MOST_FLAT * r) };
  });
}

/** Return a ball's outline about its centre: two half-ellipses that keep its volume. */
export function outline(r, { lower, upper }) {
  const up = r - upper;
  const down = r - lower;
  const side = r * Math.sqrt((2 * r) / (up + down));
  const [a, u, d] = [side, up, down].map((length) => length.toFixed(2));
  return { path: `M-${a} 0A${a} ${u} 0 0 1 ${a} 0A${a} ${d} 0 0 1 -${a} 0Z`, side };
}

export function clamp(value, low, high) {
  return Math.min(Math.max(value, low), high);
}
