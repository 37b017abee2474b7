/**
 * How balls look. A ball that is known by its name has its own pattern and colour, wherever it stands; any other ball, and one whose colour
 * another ball has, has that of its place. The colours are in style.css: `--place-N` of curves, six that everybody tells apart, and
 * `--fill-KIND` and `--mark-KIND` of the ball on the stage.
 */

import { put, s } from "../dom.js";
import { repaint } from "../plots/palette.js";

const PLACES = 6;

/**
 * Each kind: the names of its balls; the upper half of its pattern in a circle of radius 1, which is drawn twice, as the lower
 * half mirrors it; whether it is filled; and the place whose colour is most like its own.
 */
const LOOKS = {
  basketball: { balls: ["basketball", "big basketball"], place: 1, half: "M-1 0H1M0-1V0M-.72-.69Q-.4-.36-.4 0M.72-.69Q.4-.36.4 0" },
  tennis: { balls: ["tennis", "tennis ball"], place: 4, half: "M-.6-.8Q-.12-.5-.12 0M.6-.8Q.12-.5.12 0", wide: true },
  football: { balls: ["football"], place: 5, half: "M-.42 0L-.24-.34H.24L.42 0ZM-.24-.34L-.4-.66M.24-.34L.4-.66M.42 0H.8M-.42 0H-.8M-.4-.66H.4L.3-.92H-.3ZM.8 0L.86-.4.97-.2V0ZM-.8 0L-.86-.4-.97-.2V0Z", filled: true },
  handball: { balls: ["handball"], place: 3, half: "M-.5 0L-.25-.43H.25L.5 0M-.25-.43L-.48-.86M.25-.43L.48-.86M.5 0H1M-.5 0H-1" },
  volleyball: { balls: ["volleyball"], place: 0, half: "M-.98-.2Q0-.5.98-.2L.83-.55Q0-.95-.83-.55Z", filled: true },
  "ping-pong": { balls: ["ping-pong ball"], place: 4, half: "M-1 0L-.98-.2H.98L1 0Z", filled: true },
  golf: { balls: ["golf ball"], place: 2, half: "M0-.15h0M-.3-.15h0M.3-.15h0M-.6-.15h0M.6-.15h0M-.15-.42h0M.15-.42h0M-.45-.42h0M.45-.42h0M-.3-.68h0M0-.68h0M.3-.68h0M-.74-.42h0M.74-.42h0M-.86-.15h0M.86-.15h0M0-.9h0", wide: true },
  superball: { balls: ["superball"], place: 3, half: "M-.92-.38C-.5 0-.4-.9 0-.55S.5-.1.92-.38M-.6-.8C-.3-.6-.1-1 .6-.8" },
  marble: { balls: ["marble"], place: 2, half: "M-.8 0Q-.4-.75 0 0Q.4-.75.8 0Z", filled: true },
  steel: { balls: ["steel ball"], place: 5, half: "M-.72-.42Q-.35-.88.3-.82M-.5-.34Q-.3-.58 0-.6" },
};

/** Return the kind of a ball by its name, or null. */
function kindOf({ name }) {
  return Object.keys(LOOKS).find((kind) => LOOKS[kind].balls.includes(name)) ?? null;
}

/** Return the colour of each ball, as CSS writes it: its kind's where that is free, else its place's, else a free one. */
export function inksOf(balls) {
  const taken = new Set();
  const own = balls.map((ball) => {
    const place = LOOKS[kindOf(ball)]?.place ?? null;
    if (taken.has(place)) return null;
    if (place !== null) taken.add(place);
    return place;
  });
  return own.map((place, i) => {
    const found = place ?? [i, ...Array(PLACES).keys()].find((free) => !taken.has(free));
    taken.add(found);
    return `var(--place-${found})`;
  });
}

/** Keep the colours of the places, `--ball-N`, those of the balls that stand there. */
export function mountLooks(store) {
  const { style } = document.documentElement;
  let shown = "";
  const follow = ({ drop }) => {
    const inks = inksOf(drop.balls);
    if (shown === inks.join()) return;
    shown = inks.join();
    for (let place = 0; place < PLACES; place += 1) {
      if (inks[place]) style.setProperty(`--ball-${place}`, inks[place]);
      else style.removeProperty(`--ball-${place}`);
    }
    repaint();
  };
  store.subscribe(follow);
  follow(store.get());
}

/** Return the pattern of a ball for the stage, a group that `squash` fits to the ball's outline. */
export function patternOf(group, ball) {
  const kind = kindOf(ball);
  const { half, filled, wide } = LOOKS[kind] ?? { half: "" };
  if (kind) {
    group.style.setProperty("--fill", `var(--fill-${kind})`);
    group.style.setProperty("--mark", `var(--mark-${kind})`);
  }
  const look = ["ball-mark", filled && "filled", wide && "wide"].filter(Boolean).join(" ");
  const drawn = () => s("path", { class: look, d: half, "vector-effect": "non-scaling-stroke" });
  return s("g", { class: "ball-pattern", "data-look": kind }, ...(kind ? [drawn(), drawn()] : []));
}

/** Give a pattern the outline of its ball: half the width, and how far it reaches up and down, in px. */
export function squash(pattern, side, up, down) {
  const [upper, lower] = pattern.children;
  if (!upper) return;
  put(upper, "transform", `scale(${side.toFixed(2)} ${up.toFixed(2)})`);
  put(lower, "transform", `scale(${side.toFixed(2)} ${(-down).toFixed(2)})`);
}
