/** The stage: the balls at the clock's time, and the textbook's beside them as outlines. */

import { between, locate } from "./clock.js";
import { patternOf, squash } from "./ball_looks.js";
import { h, put, s, write } from "./dom.js";
import { camera, clamp, flattening, outline } from "./shape.js";
import { fixed, format } from "./units.js";
import { ballName, moment } from "./words.js";

const FOOT = 30; // px below the floor line
const HEAD = 26; // px above the highest ball
const ARROW = 46; // px of the fastest ball's arrow

let stages = 0;

/** Draw the stage into `root` and keep it at the clock's time. */
export function mountStage(root, store, clock) {
  stages += 1;
  const light = `light-${stages}`; // a gradient of a hidden stage would not be drawn
  const svg = s("svg", { class: "scene", role: "img" });
  const time = s("text", { class: "scene-time", x: 12, y: 22 });
  const scale = s("text", { class: "scene-note", x: 12, y: 42 });
  const ground = s("g", { class: "ground" });
  const ruler = s("g", { class: "ruler" });
  const ghosts = s("g", { class: "ghosts" });
  const balls = s("g", { class: "balls" });
  svg.append(shading(light), ruler, ground, balls, ghosts, time, scale);
  root.append(svg);
  const nothing = h("p", { class: "stage-empty note", text: "Computing the first drop …" });
  root.append(nothing);
  let scene = null;
  let size = null; // of the stage in px; asked for at each change, it would have the whole page laid out
  let stack = ""; // whose balls are drawn

  const build = () => {
    const { result, until, magnify } = store.get();
    size ??= root.getBoundingClientRect();
    const { width, height } = size;
    if (!result || width < 10 || height < 10) return;
    nothing.hidden = true;
    put(svg, "viewBox", `0 0 ${width} ${height}`);
    const whole = until !== null;
    const view = camera(result, { width, height: height - FOOT - HEAD, whole, asked: magnify });
    const fastest = Math.max(1e-9, ...result.frames.velocity.flat().map(Math.abs));
    scene = { result, view, whole, fastest, floor: height - FOOT, middle: width / 2, seen: null };
    drawGround(ground, result.drop, scene, width);
    drawRuler(ruler, scene, width);
    write(scale, note(scene));
    const names = JSON.stringify(result.drop.balls.map((_, ball) => ballName(result.drop, ball)));
    if (names !== stack) balls.replaceChildren(...result.drop.balls.map((_, ball) => ballGroup(result.drop, ball, light)));
    stack = names;
    const separate = result.separate?.position ?? [];
    ghosts.replaceChildren(...separate.map((_, ball) => ghostBall(ball, view)));
    clock.touch();
  };

  const draw = () => {
    if (!scene) return;
    const { frames, separate } = scene.result;
    const place = locate(frames.time, clock.time);
    const compressions = frames.compression.map((values) => between(values, place));
    const flat = flattening(compressions, scene.view);
    [...balls.children].forEach((group, ball) => {
      const position = between(frames.position[ball], place);
      const velocity = between(frames.velocity[ball], place);
      moveBall(group, scene, ball, { position, velocity, flat: flat[ball] });
    });
    [...ghosts.children].forEach((circle, ball) => {
      const position = between(separate.position[ball], place);
      put(circle, "transform", `translate(${scene.middle} ${centre(scene, ball, position)})`);
    });
    write(time, moment(clock.time, scene.whole));
    if (!clock.playing) put(svg, "aria-label", spoken(scene, clock.time, place));
  };

  const showGhosts = () => ghosts.classList.toggle("hidden", !store.get().ghosts);
  store.subscribe((state, before) => {
    if (state.result !== before.result || state.magnify !== before.magnify) build();
    if (state.ghosts !== before.ghosts) showGhosts();
  });
  clock.subscribe(draw);
  new ResizeObserver(([{ contentRect }]) => {
    size = contentRect;
    build();
  }).observe(root);
  showGhosts();
}

function centre({ view, floor }, ball, position) {
  return (floor - view.rest[ball] - view.move * position).toFixed(2);
}

function ballGroup(drop, ball, light) {
  const group = s("g", { class: "ball", "data-ball": ball });
  group.style.setProperty("--ball", `var(--ball-${ball % 6})`);
  const name = s("text", { class: "ball-name", "text-anchor": "end", text: shortened(ballName(drop, ball)) });
  put(name, "y", 4);
  const speed = s("text", { class: "ball-speed" });
  put(speed, "y", 4);
  group.append(
    s("path", { class: "ball-body" }),
    patternOf(group, drop.balls[ball]),
    s("path", { class: "ball-light", fill: `url(#${light})` }),
    s("path", { class: "ball-arrow" }),
    name,
    speed,
  );
  return group;
}

function shortened(name) {
  return name.length > 18 ? `${name.slice(0, 17)}…` : name;
}

function moveBall(group, scene, ball, { position, velocity, flat }) {
  const [body, pattern, light, arrow, name, speed] = group.children;
  const radius = scene.view.radius[ball];
  const { path, side } = outline(radius, flat);
  put(group, "data-position", position);
  put(group, "transform", `translate(${scene.middle} ${centre(scene, ball, position)})`);
  put(body, "d", path);
  put(light, "d", path);
  squash(pattern, side, radius - flat.upper, radius - flat.lower);
  put(arrow, "d", arrowPath((side + 17).toFixed(1), (-ARROW * velocity) / scene.fastest));
  put(name, "x", (-side - 10).toFixed(1));
  put(speed, "x", (side + 28).toFixed(1));
  write(speed, `${fixed(velocity, 2)} m/s`);
}

/** Return an arrow from a height of 0 to `length` px down, at `x`. */
function arrowPath(x, length) {
  if (Math.abs(length) < 1.5) return `M${x} 0m-3 0h6`;
  const head = clamp(length, -5, 5);
  const tip = length.toFixed(1);
  return `M${x} 0V${tip}m-4 ${-head}L${x} ${tip}l4 ${-head}`;
}

function ghostBall(ball, view) {
  return s("circle", { class: "ghost", r: view.radius[ball], "data-ghost": ball });
}

function drawGround(ground, drop, { floor }, width) {
  const none = (drop.contacts[0]?.law ?? "none") === "none";
  if (none) {
    ground.replaceChildren();
    return;
  }
  ground.replaceChildren(
    s("rect", { class: "ground-fill", x: 0, y: floor, width, height: FOOT }),
    s("line", { class: "ground-line", x1: 0, x2: width, y1: floor, y2: floor }),
  );
}

/** Draw heights in metres beside a whole drop. */
function drawRuler(ruler, { whole, view, floor }, width) {
  ruler.replaceChildren();
  if (!whole) return;
  const step = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 1e3, 1e4].find((one) => one * view.move >= 40) ?? 1e5;
  for (let height = step; height * view.move < floor - 48; height += step) {
    const y = floor - height * view.move;
    ruler.append(
      s("line", { x1: 0, x2: width, y1: y, y2: y }),
      s("text", { x: width - 8, y: y - 4, "text-anchor": "end", text: `${format(height, 4)} m` }),
    );
  }
}

function note({ whole, view }) {
  return whole ? "heights to scale" : `movement shown ×${format(view.times, 2)}`;
}

/** Describe the stage in words, for screen readers. */
function spoken({ result, whole }, time, place) {
  const { drop, frames } = result;
  const balls = drop.balls.map((_, ball) => {
    const position = between(frames.position[ball], place) * (whole ? 1 : 1e3);
    const speed = between(frames.velocity[ball], place);
    const way = speed > 0 ? "up" : "down";
    const unit = whole ? "m" : "mm";
    return `${ballName(drop, ball)} at ${format(position, 3)} ${unit}, ${format(Math.abs(speed), 3)} m/s ${way}`;
  });
  return `The stack at ${moment(time, whole)}, from below: ${balls.join("; ")}.`;
}

function shading(id) {
  const stop = (offset, opacity) =>
    s("stop", { offset, "stop-color": "#fff", "stop-opacity": opacity });
  const light = s("radialGradient", { id, cx: 0.36, cy: 0.3, r: 0.75 }, stop(0, 0.45), stop(0.6, 0.06), stop(1, 0));
  return s("defs", {}, light);
}
