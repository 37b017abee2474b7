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
export function largest(lists) {
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
  const nice = MAGNIFICATIONS.filter((times) => times <= third).at(-1) ?? 1;
  return Number.isFinite(third) ? Math.min(nice, room) : 1;
}

const BEYOND = 1.3; // times the balls' own height that is shown for the textbook's to be seen

/** Return the height in m that a picture needs: the balls' own, and not too far beyond it the textbook's. */
export function highest(own, theirs) {
  return Math.max(own, Math.min(theirs, BEYOND * own));
}

/** Return the near view of an impact, `{scale, move, times}`: px per metre of the balls, and of their magnified movement. */
export function closeUp(result, { width, height, asked }) {
  const radius = radii(result.drop);
  const stack = heightOf(radius);
  const times = magnification(result, asked);
  const seen = clamp(stack + times * largest(result.frames.position).at(-1), 1.15 * stack, 1.7 * stack);
  const scale = Math.min(height / seen, widest(radius, width));
  return { scale, move: scale * times, times };
}

/** Return the far view that holds a stack whose highest ball moves between two heights in m: all to scale. */
export function farView(radius, { width, height, low, high }) {
  const scale = Math.min(height / (heightOf(radius) + high - low), widest(radius, width));
  const free = height - heightOf(stacked(radius, scale).radius);
  return { scale, move: Math.min(scale, Math.max(free, 0.3 * height) / Math.max(high - low, 1e-9)), times: 1 };
}

/** Return the balls of a stack in px: each one's radius, and the height of its centre. */
export function stacked(radius, scale) {
  const drawn = radius.map((r) => Math.max(LEAST_RADIUS, r * scale));
  let below = 0;
  const rest = drawn.map((r) => {
    below += 2 * r;
    return below - r;
  });
  return { radius: drawn, rest };
}

function heightOf(radius) {
  return 2 * radius.reduce((sum, r) => sum + r, 0);
}

/** Return the largest scale at which names and speeds have room beside the balls. */
function widest(radius, width) {
  return clamp(width - 210, 0.2 * width, 0.44 * width) / (2 * Math.max(...radius));
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

/** Return where a condition ends that holds at `low`, and for all up to there; it is looked for up to `high`. */
export function bisected(holds, low, high) {
  for (let i = 0; i < 60; i += 1) {
    const middle = 0.5 * (low + high);
    if (holds(middle)) low = middle;
    else high = middle;
  }
  return low;
}

export function clamp(value, low, high) {
  return Math.min(Math.max(value, low), high);
}
