/** A view of one drawing over numbers of the drop, a line or a map: asks for it, draws it, and marks the present drop in it. */

import { fillFrom, write } from "../../dom.js";
import { haveSameDrawing, numberIn, sideOf, withNumbers } from "./sides.js";
import { isInside, point } from "./pointing.js";
import { t, writeTold } from "../../words/language.js";
import { onRepaint } from "../../plots/palette.js";
import { isAsking, saidOf } from "../../words/sentence.js";
import { mountStage } from "../../stage/stage.js";

const hovers = matchMedia("(hover: hover)"); // a mouse, which can drag; a finger scrolls
const LEAST = 20; // px, below which nothing is drawn

export class DrawingView {
  /**
   * Build a view into `root`.
   * @param {object} kind `name`, of the view, of its settings in the store and of its HTML; `role`, what it is in words; `sides`,
   * `margin` and `step`, as `point` takes them; `form(element)`, which returns what fills it with news; `requests(tell)`, which asks for drawings;
   * `sidesOf(news)`; `draw(size, news, parts)`, which returns `{frame, title, label, summary}`; `mark(news, present, pointed, parts)`;
   * `told(news, place)`; and the sentences `here` and `outside` on the present drop
   */
  constructor(root, store, clock, kind) {
    Object.assign(this, { store, kind, parts: fillFrom(root, `${kind.name}-parts`) });
    this.news = null; // the answer that is shown, with its settings and the numbers of its drop
    this.frame = null; // where the field lies in the drawing, in px
    this.due = 0; // a frame of the screen in which to draw
    this.asked = {}; // the drop and the settings that are shown, or will be
    const { parts } = this;
    parts.board.setAttribute("aria-roledescription", kind.role);
    this.fillForm = kind.form(parts.form);
    mountStage(parts.stage, store, clock);
    this.requests = kind.requests((news) => this.hear(news));
    this.pointed = point(parts, kind, this, clock);
    parts.again.addEventListener("click", () => this.refresh());
    new ResizeObserver(() => this.drawSoon()).observe(parts.board);
    onRepaint(() => this.draw());
    store.watch(["result", "predict", "guess"], (state) => this.tell(state));
    store.watch(["view", "drop", kind.name], (state, before) => this.follow(state, before));
    this.tell(store.get());
    this.refresh();
  }

  /** Ask for the drawing of the present drop. */
  refresh() {
    const { drop, [this.kind.name]: settings } = this.store.get();
    this.asked = { drop, settings };
    if (!this.news) write(this.parts.message, t("Computing …"));
    this.requests.ask(drop, settings);
  }

  hear(news) {
    const { figure, message, again } = this.parts;
    if (news.settings) this.fillForm({ answer: this.news?.answer, ...news }); // the answer before, until there is another
    figure.classList.toggle("stale", Boolean(news.problem));
    if (!news.answer && !news.problem) return;
    writeTold(message, news.problem ?? "");
    again.hidden = !news.problem;
    if (news.problem) return;
    this.news = news;
    this.drawSoon();
  }

  drawSoon() {
    this.due ||= requestAnimationFrame(() => {
      this.due = 0;
      this.draw();
    });
  }

  draw() {
    const { board, title, summary } = this.parts;
    const { width, height } = board.getBoundingClientRect();
    if (!this.news || width < LEAST || height < LEAST) return;
    const drawn = this.kind.draw({ width, height }, this.news, this.parts);
    this.frame = drawn.frame;
    write(title, drawn.title);
    write(summary, drawn.summary);
    board.setAttribute("aria-label", drawn.label);
    this.mark();
  }

  /** Mark the present drop and the place that is pointed at, and say which that is. */
  mark() {
    if (!this.frame) return;
    const { kind, news } = this;
    const [present, pointed] = [this.present(), this.pointed()];
    const isHere = isInside(present);
    kind.mark(news, isHere && !isAsking(this.store.get()) ? present : null, pointed, this.parts);
    const how = hovers.matches ? t("Drag to move it; choose a point to play its drop.") : t("Choose a point to play its drop.");
    write(this.parts.readout, pointed ? kind.told(news, pointed) : `${isHere ? kind.here : kind.outside} ${how}`);
  }

  /** Return the place of the present drop. */
  present() {
    const { kind, news, store } = this;
    const valueOf = (path) => numberIn(store.get().drop, path) ?? news.paths.find((known) => known.path === path).value;
    return kind.sidesOf(news).map((side) => sideOf(side).part(valueOf(side.path)));
  }

  /** Return the drop of a place. */
  dropAt(place) {
    const numbers = this.kind.sidesOf(this.news).map((side, i) => [side.path, sideOf(side).value(place[i])]);
    return withNumbers(this.news.answer.drop, Object.fromEntries(numbers));
  }

  play(place) {
    this.store.set({ drop: this.dropAt(place), view: "play", t: null, replay: this.store.get().replay + 1 });
    document.getElementById("tab-play")?.focus();
  }

  tell(state) {
    write(this.parts.told, state.result ? saidOf(state).lead : "");
    this.mark();
  }

  /** Follow the store: another drop of the same drawing is only marked in it. */
  follow(state, before) {
    const { name, sidesOf } = this.kind;
    if (state.view !== name) {
      if (before.view === name) this.requests.drop();
      this.asked = {};
    } else if (state[name] !== this.asked.settings || state.drop !== this.asked.drop) {
      if (!this.news) return this.refresh();
      const paths = sidesOf(this.news).map(({ path }) => path);
      const shown = this.news?.drop === this.asked.drop ? [this.news.answer.drop] : []; // as the engine writes it
      const isSame = state[name] === this.asked.settings && [this.asked.drop, ...shown].some((drop) => haveSameDrawing(state.drop, drop, paths));
      if (!isSame) return this.refresh();
      this.asked.drop = state.drop;
      this.mark();
    }
  }
}
