/** The map: how a number of the outcome depends on two numbers of the drop. */

import { scaleOfColors } from "../../plots/colors.js";
import { h, write } from "../../dom.js";
import { drawingView } from "../drawing_view.js";
import { t, translated, writeTold } from "../../words/language.js";
import { sideOf } from "./axes.js";
import { drawMap, drawMarks, frameOf } from "./draw.js";
import { mapForm } from "./form.js";
import { mapper } from "./request.js";
import { haveSameMap, numberIn, outcome, place, summary as inWords, withNumbers } from "./in_words.js";
import { onRepaint, palette } from "../../plots/palette.js";
import { storyOf } from "../../words/sentence.js";
import { mountStage } from "../../stage/stage.js";
import { capital } from "../../words/words.js";

const hovers = matchMedia("(hover: hover)"); // a mouse, which can drag; a finger scrolls
const STILL = 4; // px that a mouse may move in a click
const STEP = 1 / 60; // of a side, for one press of an arrow
const KEYS = t("Arrow keys move a crosshair, with Shift in larger steps, Home goes to the present drop. Enter plays the drop there.");

/** Build the view into `root`. */
export function mount(root, store, api, clock) {
  const parts = build();
  const form = mapForm((map) => store.set({ map }));
  const side = h("div", { class: "map-side" }, form.element, parts.stage, parts.told, parts.summary);
  root.replaceChildren(parts.figure, side, h("div", { class: "set-up-place" }));
  mountStage(parts.stage, store, clock);
  let answer = null;
  let pointed = null; // [x, y] as fractions of the sides
  let due = 0; // a frame in which to draw
  let asked = []; // the drop and the settings of the last request
  let held = null; // where the mouse was pressed, and whether it has moved since

  const requests = mapper(api, (news) => {
    if (news.settings) form.update(news);
    if (news.answer) {
      answer = { ...inOurLanguage(news.answer), settings: news.settings, paths: news.paths };
      write(parts.message, "");
      parts.again.hidden = true;
      drawSoon();
    }
    parts.figure.classList.toggle("stale", Boolean(news.problem));
    if (news.problem) {
      writeTold(parts.message, news.problem);
      parts.again.hidden = false;
    }
  });
  const refresh = () => {
    const { view, drop, map } = store.get();
    if (view !== "map") {
      requests.drop();
      asked = [];
      return;
    }
    asked = [drop, map];
    if (!answer) write(parts.message, t("Computing …"));
    requests.ask(drop, map);
  };
  const tell = ({ result, until }) => write(parts.told, result ? storyOf(result, until).lead : "");
  const draw = () => {
    if (!answer || root.hidden) return;
    const whole = answer.show.startsWith("collisions");
    drawMap(parts.drawing, answer, answer.settings, scaleOfColors(answer.values, whole), palette());
    write(parts.summary, inWords(answer));
    parts.board.setAttribute("aria-label", t("Map: {what}; across, {x}; up, {y}", { what: answer.label, x: answer.x.label, y: answer.y.label }));
    write(parts.title, capital(answer.label));
    mark();
  };
  const drawSoon = () => {
    due ||= requestAnimationFrame(() => {
      due = 0;
      draw();
    });
  };
  const mark = () => {
    const there = present();
    drawMarks(parts.marks, inside(there) ? there : null, pointed, palette());
    const where = inside(there) ? t("The cross is the present drop.") : t("The present drop lies outside of this map.");
    const how = hovers.matches ? t("Drag to move it; choose a point to play its drop.") : t("Choose a point to play its drop.");
    write(parts.readout, pointed ? told(pointed) : `${where} ${how}`);
  };
  /** Return the place of the present drop, as fractions of the sides. */
  const present = () => {
    const { settings, paths } = answer;
    return [settings.x, settings.y].map((side) =>
      sideOf(side).part(numberIn(store.get().drop, side.path) ?? paths.find(({ path }) => path === side.path).value),
    );
  };
  /** Return the values and the nearest outcome at a place given as fractions of the sides. */
  const at = ([x, y]) => {
    const { settings, values } = answer;
    const nearest = (part, count) => Math.round(part * (count - 1));
    return {
      point: [sideOf(settings.x).value(x), sideOf(settings.y).value(y)],
      value: values[nearest(y, values.length)][nearest(x, values[0].length)],
    };
  };
  const told = (spot) => {
    const { point, value } = at(spot);
    return `${capital(place(answer, point))}: ${outcome(answer, value)}.`;
  };
  /** Return the drop of the point that is pointed at. */
  const chosenDrop = () => {
    const { point } = at(pointed);
    const { x, y } = answer.settings;
    return withNumbers(answer.drop, { [x.path]: point[0], [y.path]: point[1] });
  };
  const play = () => {
    if (!answer || !pointed) return;
    store.set({ drop: chosenDrop(), view: "play", t: null, replay: store.get().replay + 1 });
    parts.play.hidden = true;
    document.getElementById("tab-play")?.focus();
  };

  const follow = (event) => {
    if (!answer) return;
    const box = parts.marks.getBoundingClientRect();
    const frame = frameOf(box.width, box.height);
    const spot = [
      (event.clientX - box.left - frame.left) / frame.width,
      1 - (event.clientY - box.top - frame.top) / frame.height,
    ];
    pointed = inside(spot) ? spot : null;
    mark();
  };
  parts.board.addEventListener("pointermove", (event) => {
    follow(event);
    if (!held || !answer) return;
    held.moved ||= Math.hypot(event.clientX - held.x, event.clientY - held.y) > STILL;
    if (held.moved && pointed) store.set({ drop: chosenDrop() });
  });
  parts.board.addEventListener("pointerdown", (event) => {
    follow(event);
    held = null;
    if (event.button !== 0 || event.pointerType === "touch") return; // a finger scrolls the page
    held = { x: event.clientX, y: event.clientY, moved: false };
    parts.board.setPointerCapture(event.pointerId);
  });
  parts.board.addEventListener("pointerleave", (event) => {
    if (event.pointerType !== "mouse") return;
    pointed = null;
    if (answer) mark();
  });
  parts.board.addEventListener("click", (event) => {
    const dragged = held?.moved;
    held = null;
    follow(event);
    if (dragged) {
      clock.seek(clock.begin);
      clock.play();
      return;
    }
    // A finger hides the point that it touches, so a touch only selects; the button plays.
    if (event.pointerType === "touch") parts.play.hidden = !pointed;
    else play();
  });
  parts.play.addEventListener("click", play);
  parts.board.addEventListener("keydown", (event) => {
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key];
    if (!answer || (!way && !["Enter", "Home", "Escape"].includes(event.key))) return;
    event.preventDefault();
    if (event.key === "Enter") return play();
    if (event.key === "Escape") pointed = null;
    else if (!way || !pointed) pointed = present().map(within);
    else pointed = pointed.map((part, i) => within(part + way[i] * STEP * (event.shiftKey ? 10 : 1)));
    mark();
    write(parts.live, pointed ? told(pointed) : "");
    parts.play.hidden = !pointed;
  });
  parts.again.addEventListener("click", refresh);
  new ResizeObserver(drawSoon).observe(parts.board);
  onRepaint(draw);
  store.subscribe((state, before) => {
    if (state.result !== before.result) tell(state);
    if (answer && state.view === "map" && state.drop !== asked[0] && state.map === asked[1]) {
      const { x, y } = answer.settings;
      if (haveSameMap(state.drop, asked[0], [x.path, y.path])) {
        asked[0] = state.drop;
        mark();
      }
    }
    if (state.view === "map" && (state.drop !== asked[0] || state.map !== asked[1])) refresh();
    else if (state.view !== "map" && asked.length) refresh();
  });
  tell(store.get());
  refresh();
}

/** Return a map with its labels, which the engine has in English, in the page's language. */
function inOurLanguage(answer) {
  const side = (one) => ({ ...one, label: translated(one.label) });
  return { ...answer, label: translated(answer.label), x: side(answer.x), y: side(answer.y) };
}

function inside(spot) {
  return spot.every((part) => part >= 0 && part <= 1);
}

function within(part) {
  return Math.min(Math.max(part, 0), 1);
}

function build() {
  const field = h("canvas", { class: "map-field", "aria-hidden": "true" });
  const marks = h("canvas", { class: "map-marks", "aria-hidden": "true" });
  return drawingView("map", KEYS, field, marks);
}
