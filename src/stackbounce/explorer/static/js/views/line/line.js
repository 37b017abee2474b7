/** The line: the rebound over one number of the drop, with the present drop as a point on it. */

import { h, renew, s, write } from "../../dom.js";
import { drawingView } from "../drawing_view.js";
import { complete } from "../../set_up/drops.js";
import { t, translated, writeTold } from "../../words/language.js";
import { drawLine, drawLineMarks } from "./draw.js";
import { lineForm } from "./form.js";
import { liner } from "./request.js";
import { fileOf } from "./save.js";
import { SHOWS, summary, told, valueAt } from "./in_words.js";
import { sideOf } from "../map/axes.js";
import { brief, haveSameMap, numberIn, withNumbers } from "../map/in_words.js";
import { onRepaint, palette } from "../../plots/palette.js";
import { download } from "../../state/share.js";
import { storyOf } from "../../words/sentence.js";
import { mountStage } from "../../stage/stage.js";
import { withExample } from "../../state/store.js";

const hovers = matchMedia("(hover: hover)"); // a mouse, which can drag; a finger scrolls
const STILL = 4; // px that a mouse may move in a click
const STEP = 1 / 100; // of the side, for one press of an arrow
const KEYS = t("Left and right arrow move a crosshair, with Shift in larger steps, Home goes to the present drop. Enter plays the drop there.");

/** Build the view into `root`. */
export async function mount(root, store, api, clock) {
  const { lines: figures } = await api.catalogue();
  const parts = build();
  let answer = null;
  let paths = [];
  let drawing = null;
  let due = 0; // a frame in which to draw
  let pointed = null; // part of the side, from 0 to 1
  let held = null; // where the mouse was pressed, and whether it has moved since
  let asked = {}; // the drop and the settings that are shown, or will be

  const use = (figure) => {
    if (!figure) return;
    const line = { x: figure.x, show: "rebound_ratio" };
    store.set({ ...withExample(store.get(), complete(figure.drop)), line });
  };
  const save = async (kind) => {
    if (answer) download(await fileOf(kind, answer, measured()), `stackbounce-line.${kind}`);
  };
  const form = lineForm(figures, { set: (line) => store.set({ line }), use, save });
  const side = h("div", { class: "line-side" }, form.element, parts.stage, parts.told, parts.summary);
  root.replaceChildren(parts.figure, side, h("div", { class: "set-up-place" }));
  mountStage(parts.stage, store, clock);

  const requests = liner(api, (news) => {
    parts.figure.classList.toggle("stale", Boolean(news.problem));
    writeTold(parts.message, news.problem ?? "");
    parts.again.hidden = !news.problem;
    if (news.problem) return;
    ({ answer, paths } = news);
    form.update({ ...news, figure: figureOf(figures, answer) });
    drawSoon();
  });
  const refresh = () => {
    const { drop, line } = store.get();
    asked = { drop, line };
    if (!answer) write(parts.message, t("Computing …"));
    requests.ask(drop, line);
  };
  const measured = () => figureOf(figures, answer)?.measured ?? [];
  const draw = () => {
    const { width, height } = parts.board.getBoundingClientRect();
    if (!answer || width < 20 || height < 20) return;
    const colors = palette();
    drawing = drawLine(answer, { width, height }, colors, measured());
    renew(parts.drawing, drawing.svg);
    const shows = SHOWS.get(answer.show);
    write(parts.title, t("{what} against {number}", { what: shows, number: brief(translated(answer.x.label)) }));
    write(parts.summary, summary(answer));
    parts.board.setAttribute("aria-label", t("Line: {what}; across, {number}", { what: shows, number: translated(answer.x.label) }));
    mark();
  };
  const drawSoon = () => {
    due ||= requestAnimationFrame(() => {
      due = 0;
      draw();
    });
  };
  const mark = () => {
    if (!drawing) return;
    const there = present();
    const values = (part) => answer.curves.map((curve) => ({ index: curve.index, value: valueAt(answer, curve, part) }));
    const spot = (part, present) => (part === null || !inside(part) ? [] : [{ part, values: values(part), present }]);
    drawLineMarks(parts.marks, drawing, [...spot(there, true), ...spot(pointed, false)], palette());
    const where = inside(there) ? t("The dots are the present drop.") : t("The present drop lies outside of this line.");
    const how = `${where} ${hovers.matches ? t("Drag to move it; choose a point to play its drop.") : t("Choose a point to play its drop.")}`;
    write(parts.readout, pointed === null ? how : told(answer, pointed));
  };
  /** Return the place of the present drop, as a part of the side. */
  const present = () => {
    const { x } = answer;
    return sideOf(x).part(numberIn(store.get().drop, x.path) ?? paths.find(({ path }) => path === x.path).value);
  };
  const chosenDrop = () => withNumbers(answer.drop, { [answer.x.path]: sideOf(answer.x).value(pointed) });
  const play = () => {
    if (!answer || pointed === null) return;
    store.set({ drop: chosenDrop(), view: "play", t: null, replay: store.get().replay + 1 });
    parts.play.hidden = true;
    document.getElementById("tab-play")?.focus();
  };

  const follow = (event) => {
    if (!drawing) return;
    const { frame } = drawing;
    const box = parts.board.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left - frame.left, event.clientY - box.top - frame.top];
    const over = held?.moved || (y >= 0 && y <= frame.height && x >= -STILL && x <= frame.width + STILL);
    pointed = over ? within(x / frame.width) : null;
    mark();
  };
  parts.board.addEventListener("pointermove", (event) => {
    if (held) held.moved ||= Math.abs(event.clientX - held.x) > STILL;
    follow(event);
    if (held?.moved && pointed !== null) store.set({ drop: chosenDrop() });
  });
  parts.board.addEventListener("pointerdown", (event) => {
    held = null;
    follow(event);
    if (event.button !== 0 || event.pointerType === "touch" || pointed === null) return; // a finger scrolls the page
    held = { x: event.clientX, moved: false };
    parts.board.setPointerCapture(event.pointerId);
  });
  parts.board.addEventListener("pointerleave", (event) => {
    if (event.pointerType !== "mouse" || held) return;
    pointed = null;
    mark();
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
    if (event.pointerType === "touch") parts.play.hidden = pointed === null;
    else play();
  });
  parts.play.addEventListener("click", play);
  parts.board.addEventListener("keydown", (event) => {
    const way = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!answer || (!way && !["Enter", "Home", "Escape"].includes(event.key))) return;
    event.preventDefault();
    if (event.key === "Enter") return play();
    if (event.key === "Escape") pointed = null;
    else if (!way || pointed === null) pointed = within(present());
    else pointed = within(pointed + way * STEP * (event.shiftKey ? 10 : 1));
    mark();
    write(parts.live, pointed === null ? "" : told(answer, pointed));
    parts.play.hidden = pointed === null;
  });
  parts.again.addEventListener("click", refresh);
  new ResizeObserver(draw).observe(parts.board);
  onRepaint(draw);
  store.subscribe((state, before) => {
    if (state.result !== before.result) tell(state);
    if (state.view !== "line") {
      if (before.view === "line") requests.drop();
      asked = {};
    } else if (state.line !== asked.line || state.drop !== asked.drop) {
      const same = answer && state.line === asked.line && haveSameMap(state.drop, answer.drop, [answer.x.path]);
      if (!same) return refresh();
      asked.drop = state.drop;
      mark();
    }
  });
  const tell = ({ result, until }) => write(parts.told, result ? storyOf(result, until).lead : "");
  tell(store.get());
  refresh();
}

/** Return the paper's line that an answer is, at whatever value of the number that varies. */
function figureOf(figures, { drop, x }) {
  const same = (one) => ["path", "low", "high", "log"].every((name) => one.x[name] === x[name]);
  return figures.find((one) => same(one) && haveSameMap(drop, complete(one.drop), [x.path]));
}

function inside(part) {
  return part >= 0 && part <= 1;
}

function within(part) {
  return Math.min(Math.max(part, 0), 1);
}

function build() {
  const drawing = h("div", { class: "line-drawing", "aria-hidden": "true" });
  const marks = s("svg", { class: "line-marks", width: "100%", height: "100%", "aria-hidden": "true" });
  return drawingView("line", KEYS, drawing, marks);
}
