/** A record beside the simulated drop: keeps both and the plots in step; a track is shifted to where it lies best. */

import { h, partsOf } from "../../dom.js";
import { GRAVITY } from "../../set_up/drops.js";
import { choice } from "../../set_up/fields.js";
import { t, translated } from "../../words/language.js";
import { bestShift, laid, lines, matched, shifted } from "./record.js";
import { recordPlot } from "../../plots/record_plot.js";
import { ballName, capital, contactName } from "../../words/words.js";

const ASK = { force: t("The record is of one contact. Which?"), position: t("The record is of one ball. Which?") };
const LONGEST = 10; // s of a track that are simulated

/** Draws into `card`, and hands the store's `overlays` to the play view; `moved` hears over what a record is to lie. */
export class Overlay {
  constructor(card, store, api, moved) {
    const { over, notes } = partsOf(card);
    Object.assign(this, { card, store, api, moved, over, notes, plot: recordPlot(card) });
    this.target = null; // the ball or contact that the user chose for a record of one
    this.record = null;
    this.asked = 0;
  }

  /** Take a record `{series, zero}`, and look where it lies best. */
  show(record) {
    this.record = record;
    this.shift = 0;
    this.fresh = true;
    this.target = null;
    this.store.set({ overlays: [] });
    this.card.hidden = record.series.length === 0;
    if (!this.card.hidden) this.follow();
  }

  clear() {
    this.record = null;
    this.card.hidden = true;
    this.store.set({ overlays: [] });
  }

  /** Draw the record beside what is now simulated. */
  async follow() {
    if (!this.record?.series.length) return;
    const { drop } = this.store.get();
    if (this.target !== null && this.target >= drop.balls.length) this.target = null;
    const curves = laid({ ...this.record, series: this.series() }, drop);
    this.sayOver(curves);
    this.asked += 1;
    const mine = this.asked;
    const result = curves.length ? await this.simulated(curves).catch(() => null) : null;
    if (mine !== this.asked || !this.record) return;
    this.result = result;
    this.curves = result ? curves : this.record.series;
    this.lines = result ? lines(result, curves) : null;
    if (result && this.fresh && curves[0].what === "position") this.shift = bestShift(curves, this.lines, this.reach, 0.5 * (result.impact[0] + result.impact[1]));
    this.fresh = false;
    this.draw();
  }

  /** Return the curves of the record; one alone is that of the ball or contact that was chosen. */
  series() {
    const { series } = this.record;
    return this.target === null || series.length !== 1 ? series : [{ ...series[0], index: this.target }];
  }

  /** Say over what the record lies; where it is of one ball or contact and there are several, ask. */
  sayOver(curves) {
    const { drop } = this.store.get();
    this.over.hidden = curves.length === 0;
    if (this.over.hidden) return;
    const places = drop.balls.map((_, i) => [String(i), this.place(curves[0].what, i)]);
    if (this.record.series.length === 1 && places.length > 1) {
      const set = (value) => {
        this.target = Number(value);
        this.fresh = true;
        this.moved(this.target);
        this.follow();
      };
      const asked = choice({ label: ASK[curves[0].what], key: "over", groups: [["", places]], value: String(curves[0].index), set });
      const note = h("p", { class: "note", text: t("It lies over the drop of the whole stack. The record of a ball that bounced alone fits a drop of that ball alone.") });
      if (this.asking !== JSON.stringify([places, curves[0].index])) this.over.replaceChildren(asked, note);
      this.asking = JSON.stringify([places, curves[0].index]);
      return;
    }
    this.asking = "";
    const named = curves.map(({ what, index }) => this.place(what, index)).join(", ");
    this.over.replaceChildren(h("p", { class: "note", text: t("It lies over {places}.", { places: named }) }));
  }

  /** Return what a curve of a record can lie over, in words. */
  place(what, index) {
    const { drop } = this.store.get();
    return what === "force" ? contactName(drop, index) : ballName(drop, index);
  }

  /** Return the simulation to compare with: the impact for a force, the whole drop with gravity for a track. */
  async simulated(curves) {
    const { drop, result, until } = this.store.get();
    if (curves[0].what === "force") {
      const now = result && until === null ? result : await this.api.simulate(drop);
      return now.frames.force.length ? now : null;
    }
    const end = Math.max(...curves.map(({ time }) => time.at(-1)));
    return this.api.simulate({ ...drop, gravity: drop.gravity || GRAVITY }, Math.min(Math.max(end, 0.05), LONGEST));
  }

  /** How far a record's clock may be shifted: as long as the impact lasts. */
  get reach() {
    const [begin, end] = this.result?.impact ?? [0, 0];
    return Math.max(end - begin, 1e-3);
  }

  draw() {
    const { result } = this;
    const put = result ? matched(shifted(this.curves, this.shift), this.lines) : { curves: this.curves, notes: [] };
    this.plot({
      record: this.record,
      curves: put.curves,
      simulated: this.lines,
      names: put.curves.map((curve) => this.name(curve)),
      window: result ? [result.impact[0] - 0.25 * this.reach, result.impact[1] + 0.5 * this.reach] : null,
      whole: put.curves[0].what === "position",
    });
    this.notes.replaceChildren(...put.notes.map((text) => h("p", { text: capital(text) })));
    if (result) {
      this.store.set({ overlays: put.curves.map((curve) => ({ ...curve, label: t("measured {what}", { what: translated(curve.label) }) })) });
    }
  }

  name({ what, index, label }) {
    return this.result && what === "force" ? contactName(this.store.get().drop, index) : translated(label);
  }
}
