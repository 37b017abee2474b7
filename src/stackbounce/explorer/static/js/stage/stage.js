/** The stage: a room with the balls at the clock's time, the textbook's behind them, and a ruler beside them. */

import { copyOf, letDrag, partsOf, put, s, write } from "../dom.js";
import { locate } from "./clock.js";
import { filmOf, pieceAt } from "./film.js";
import { cameraOf } from "./camera.js";
import { t } from "../words/language.js";
import { radii, stacked } from "./shape.js";
import { ballGroup, besideOf, ghostGroup, height as heightAt, keptGroups, moveBalls, moveKept } from "./balls.js";
import { drawForces } from "./forces.js";
import { drawRoom } from "./room.js";
import { drawRuler } from "./ruler.js";
import { ballName, format, happening, moment, pace } from "../words/words.js";

const FOOT = 56; // px below the floor line
const HEAD = 64; // px above the highest ball, for the time
const MIDDLE = 0.46; // of the width, where the balls are
const PAIR = [0.27, 0.68]; // the same of two drops side by side
const PHASES = { fall: t("fall, "), leap: t("leap, "), before: "", impact: t("impact, "), between: t("between contacts, "), after: "", back: t("fall, "), whole: "" };
const GUESSED = 4; // times the drop height that can be guessed, at least
const WORDY = 320; // px, from which there is room for a whole sentence
const NEARLY = 1e-9; // of the film's time: at an event
const LETTER = 1.25; // times its size, that a line of words takes
const WOUND = 6; // s of film that a finger winds across the stage: the impact
const NOTCH = 0.2; // px of a drag, for each px that a wheel would scroll

/** Draw the stage into `root` and keep it at the clock's time; `onRuler` hears in each frame where the ruler is. */
export function mountStage(root, store, clock, onRuler = () => null) {
  const copy = copyOf("scene-parts");
  const { svg, time, scale, count, room, forces, ruler, trails, kept, ghosts, balls, centre, nothing } = partsOf(copy); // svg is an image once it has words
  root.append(copy);
  let scene = null;
  let size = null; // of the stage in px; asked for at each change, it would have the whole page laid out
  let letter = 0; // px of a line of words
  let stack = ""; // whose balls are drawn

  const build = () => {
    const { result, until, magnify, kept: other, predict } = store.get();
    size ??= root.getBoundingClientRect();
    letter ||= LETTER * parseFloat(getComputedStyle(scale).fontSize);
    const { width, height } = size;
    if (!result || width < 10 || height < 10) return;
    nothing.remove();
    put(svg, "viewBox", `0 0 ${width} ${height}`);
    const film = clock.film?.result === result ? clock.film : filmOf(result, until);
    const also = other && !film.whole ? filmOf(other) : null;
    const least = predict && !film.whole ? GUESSED * film.at(film.begin).position.at(-1) : 0;
    const picture = { width: also ? 0.7 * width : width, height: height - FOOT - HEAD };
    const camera = cameraOf(film, result, { ...picture, magnify, also, least });
    const [middle, beside] = also ? PAIR.map((part) => part * width) : [MIDDLE * width];
    const fastest = Math.max(1e-9, ...result.frames.velocity.flat().map(Math.abs));
    scene = { result, film, camera, fastest, floor: height - FOOT, foot: FOOT, middle, also, beside, width, letter };
    scene.moveRoom = drawRoom(room, scene);
    scene.moveForces = drawForces(forces, scene);
    scene.moveRuler = drawRuler(ruler, scene);
    const names = JSON.stringify(result.drop.balls.map((_, ball) => ballName(result.drop, ball)));
    if (names !== stack) {
      balls.replaceChildren(...result.drop.balls.map((_, ball) => ballGroup(result.drop, ball)));
      trails.replaceChildren(...result.drop.balls.map((_, ball) => s("path", { class: "trail", "--ball": `var(--ball-${ball % 6})` })));
    }
    if (names !== stack || Boolean(film.ghosts) !== ghosts.hasChildNodes()) ghosts.replaceChildren(...(film.ghosts ? ghostGroup(result.drop) : []));
    stack = names;
    kept.replaceChildren(...(also ? keptGroups(other.drop) : []));
    if (also) scene.keptRadius = radii(other.drop);
    clock.touch();
  };

  const draw = () => {
    if (!scene) return;
    const { film, camera, floor, middle } = scene;
    const now = film.at(clock.time);
    const view = camera.at(clock.time, now.position);
    const drawn = { ...scene, view, legible: clock.legible, whole: film.whole, lies: (ball) => film.lies(ball, clock.time) };
    moveBalls([...balls.children], now, drawn, [ghosts, store.get().ghosts ? film.ghosts?.at(clock.time) : null]);
    scene.moveRoom(view, now, middle);
    scene.moveForces(view, clock.time, now);
    if (scene.also) {
      const beside = { ...view, ...stacked(scene.keptRadius, view.scale) };
      moveKept(kept, scene.also.at(clock.time), { view: beside, floor, middle: scene.beside });
    }
    moveTrails(trails, scene, view, clock.time);
    moveCentre(centre, scene, view, now);
    scene.moveRuler(view, clock.time, pieceAt(film, clock.time).phase === "top");
    onRuler(rulerPlace(scene, view));
    if (clock.legible) {
      const { predict, guess } = store.get();
      const asks = predict && guess === null && !clock.playing && clock.time === clock.begin;
      const said = asks ? { time: "", note: "" } : words(scene, clock, view);
      write(time, said.time);
      write(scale, said.note);
      write(count, countOf(scene, clock.time));
    }
    if (!clock.playing || !svg.hasAttribute("aria-label")) put(svg, "aria-label", spoken(scene, clock.time, now));
    put(svg, "role", "img");
  };

  const showParts = () => {
    const { arrows, forces: pushes, centre: mass, ghosts: pale } = store.get();
    ruler.classList.toggle("no-textbook", !pale);
    forces.classList.toggle("hidden", !pushes);
    balls.classList.toggle("no-arrows", !arrows);
    centre.classList.toggle("hidden", !mass);
  };
  letWind(svg, store, clock, () => size.width);
  store.watch(["result", "magnify", "kept", "predict"], build);
  store.watch(["arrows", "forces", "centre", "ghosts"], showParts);
  store.watch(["ghosts"], () => clock.touch());
  clock.subscribe(draw);
  new ResizeObserver(([{ contentRect }]) => {
    size = contentRect;
    letter = 0;
    build();
  }).observe(root);
  showParts();
}

/** Return how many collisions there were until a time, where there are many. */
function countOf({ film }, time) {
  if (!film.counted) return "";
  const { index, fraction } = locate(film.begins, time);
  const met = time < film.begins[0] ? 0 : index + (fraction === 1 ? 2 : 1);
  return t("{count} collisions", { count: met });
}

/** Let a drag across the stage wind the film by hand, and the wheel where it does not scroll the page. */
function letWind(svg, store, clock, widthOf) {
  let from = null; // {x, reel} where the drag began
  const may = () => {
    const { predict, guess } = store.get();
    return !(predict && guess === null) && clock.film !== null;
  };
  const begins = ({ target }) => {
    from = null;
    return may() && !target.closest("[data-ball]");
  };
  const wind = (reel, way) => {
    clock.pause();
    clock.wind(reel + (WOUND * way) / widthOf());
  };
  letDrag(svg, begins, ({ clientX }) => {
    from ??= { x: clientX, reel: clock.reel };
    wind(from.reel, clientX - from.x);
  });
  svg.addEventListener("wheel", (event) => {
    if (document.documentElement.scrollHeight > innerHeight || event.ctrlKey || !may()) return;
    event.preventDefault();
    wind(clock.reel, event.deltaY * NOTCH);
  });
}

/** Draw how far each ball has come since the impact: from where its mark is measured to the mark. */
function moveTrails(root, { film, floor, middle }, view, time) {
  const flies = !film.whole && time > film.last;
  put(root, "visibility", flies ? "visible" : "hidden");
  if (!flies) return;
  const now = film.at(time);
  [...root.children].forEach((line, ball) => {
    const top = film.tops[ball];
    const isUp = top && time > top.time;
    const lowest = (position) => (Number(heightAt(view, floor, ball, position)) + view.radius[ball]).toFixed(2);
    const from = middle + besideOf(view, { sideways: now.begun, begun: now.begun }, ball);
    const to = middle + besideOf(view, isUp ? film.at(top.time) : now, ball);
    // A parabola leaves along the line to a point half as far aside, as high as without gravity.
    const risen = top ? (isUp ? 1 : (time - film.last) / (top.time - film.last)) : 0;
    const end = lowest(isUp ? top.height : now.position[ball]);
    put(line, "d", `M${from} ${lowest(0)}Q${0.5 * (from + to)} ${top ? lowest(risen * top.height) : end} ${to} ${end}`);
  });
}

/** Return where the ruler of the highest ball is: its zero and its scale in px, and how near the camera is. */
function rulerPlace({ film, floor, width }, { lift, rest, radius, move, near }) {
  const fallen = film.at(film.begin).position[0];
  return { zero: floor - lift - rest.at(-1) + radius.at(-1), scale: move, width, near, fallen };
}

/** Mark the centre of mass of the balls as they are drawn. */
function moveCentre(mark, { result, floor, middle }, view, { position }) {
  const { balls } = result.drop;
  const mass = balls.reduce((sum, ball) => sum + ball.mass, 0);
  const y = balls.reduce((sum, ball, i) => sum + (ball.mass / mass) * Number(heightAt(view, floor, i, position[i])), 0);
  put(mark, "transform", `translate(${middle} ${y.toFixed(2)})`);
}

/** Return the words on the stage: the time, or the event at it, how fast the film is, and the scale. */
function words({ film, camera, result, width }, clock, view) {
  const { phase, from, to, length } = pieceAt(film, clock.time);
  const event = clock.playing ? null : film.events.find(({ time }) => Math.abs(time - clock.time) <= NEARLY * (film.end - film.begin));
  const speed = pace(length / (to - from) / clock.speed);
  const magnified = view.near > 0.5 && camera.times > 1;
  const scale = magnified ? t(", movement shown ×{times}", { times: format(camera.times, 2) }) : "";
  const now = moment(clock.time, film.whole);
  const some = width >= WORDY && result.drop.balls.some((_, ball) => film.lies(ball, clock.time));
  const lies = some ? t("; its next bounce is not shown") : "";
  const counts = film.counted && phase === "between";
  const note = phase === "top" ? t("at the top the film stands still") : counts ? t("slowed so that collisions can be counted") : `${PHASES[phase]}${speed}${scale}${lies}`;
  return { time: event ? `${now}: ${happening(result.drop, event)}` : now, note };
}

/** Describe the stage in words, for screen readers. */
function spoken({ result, film }, time, { position, velocity }) {
  const { drop } = result;
  const balls = drop.balls.map((_, ball) => {
    const way = velocity[ball] > 0 ? t("up") : t("down");
    const [place, unit] = film.whole ? [position[ball], "m"] : [position[ball] * 1e3, "mm"];
    return t("{ball} at {place} {unit}, {speed} m/s {way}", { ball: ballName(drop, ball), place: format(place, 3), unit, speed: format(Math.abs(velocity[ball]), 3), way });
  });
  return t("The stack at {time}, from below: {balls}.", { time: moment(time, film.whole), balls: balls.join("; ") });
}
