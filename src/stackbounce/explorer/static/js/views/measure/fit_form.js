/** The form of a fit: the measured values, the numbers that vary, and the outcome. */

import { button, h, write } from "../../dom.js";
import { problemLine } from "../../set_up/fields.js";
import { describeFit, describeVerdict } from "./fit_words.js";
import { t } from "../../words/language.js";
import { converted, lossOf } from "../../set_up/laws.js";
import { measuredRows, quantityNames } from "./measured_rows.js";
import { variedNumbers } from "./varied_numbers.js";
import { whichBall } from "./which_ball.js";

const START = 0.75; // the restitution that a fit begins with where the law lost no energy

/** The form; `fitted` hears each answer. */
export class FitForm {
  constructor(store, api, fitted) {
    Object.assign(this, { store, api, fitted, rows: measuredRows(store), vary: variedNumbers(), problem: problemLine() });
    this.record = null; // the results of a file, {measured, file, options}
    this.shape = ""; // of the drop that the form has choices for
    this.before = null; // the drop before the fit
    this.alone = this.buildAlone();
    this.status = h("p", { class: "note", role: "status" });
    this.submit = button(t("Fit"), null, { type: "submit", class: "primary" });
    this.undo = button(t("Back to the drop before"), () => this.takeBack(), { hidden: true });
    this.outcome = h("div", { class: "fit-outcome" });
    this.element = this.build();
    this.element.addEventListener("submit", (event) => {
      event.preventDefault();
      this.fit();
    });
  }

  build() {
    const addRow = () => this.rows.add().querySelector("select").focus();
    return h(
      "form",
      { class: "fit", "aria-labelledby": "fit-title", autocomplete: "off" },
      h("h2", { id: "fit-title", text: t("Fit the drop to it") }),
      h(
        "fieldset",
        {},
        h("legend", { text: t("What was measured") }),
        this.alone.element,
        this.rows.element,
        button(t("Add a measured value"), addRow),
      ),
      this.vary.element,
      h("div", { class: "fit-buttons" }, this.submit, this.undo),
      this.status,
      this.problem.element,
      this.outcome,
    );
  }

  /** Return `{element, ask(drop)}`: which ball the file is of, where it is of one alone and the drop is a stack. */
  buildAlone() {
    const drop = button(t("Drop this ball alone"), () => this.dropAlone());
    const which = whichBall(t("Which ball?"), "alone", drop);
    const says = h("p", { text: t("The file is of one ball alone; the drop is a stack.") });
    return { ...which, element: h("div", { class: "fit-alone", hidden: true }, says, which.element, drop) };
  }

  /** Take the results of a file, or null. */
  offer(record) {
    const { drop } = this.store.get();
    const measured = record?.measured ?? {};
    const isAlone = Object.keys(measured).join() === "rebound_ratios.0" && drop.balls.length > 1;
    this.record = record;
    this.alone.element.hidden = !isAlone;
    if (isAlone) this.alone.ask(drop);
    this.rows.fill(isAlone ? {} : measured);
    this.outcome.replaceChildren();
    this.undo.hidden = true;
    this.problem.show();
    write(this.status, "");
    this.offerVaried();
  }

  async offerVaried() {
    const { drop } = this.store.get();
    const { laws } = await this.api.catalogue();
    const { paths } = await this.api.mapPaths(drop).catch(() => ({ paths: [] }));
    if (drop !== this.store.get().drop) return;
    this.shape = shapeOf(drop);
    this.vary.offer(laws, drop, paths, this.rows.haveClocks());
  }

  /** Adapt the form to the store's drop. */
  follow() {
    if (shapeOf(this.store.get().drop) !== this.shape) this.offer(this.record);
  }

  /** Let the record be that of another ball or contact. */
  retarget(index) {
    const moved = Object.entries(this.record.measured).map(([name, value]) => [name.replace(/\.\d+$/, `.${index}`), value]);
    this.offer({ ...this.record, measured: Object.fromEntries(moved) });
  }

  async dropAlone() {
    this.problem.show();
    try {
      const drop = await aloneDrop(this.api, await this.api.catalogue(), this.store.get().drop, this.alone.ball());
      this.store.set({ drop });
    } catch (error) {
      this.problem.show(error.message);
    }
  }

  async fit() {
    const { drop } = this.store.get();
    this.submit.disabled = true;
    this.problem.show();
    write(this.status, t("Fitting …"));
    try {
      const answer = await this.api.fit(this.request(drop));
      this.before = drop;
      this.undo.hidden = false;
      this.outcome.replaceChildren(...describeFit(answer, { ...this.vary.labels(), ...quantityNames(drop) }));
      write(this.status, describeVerdict(answer));
      this.fitted(answer);
    } catch (error) {
      write(this.status, "");
      this.problem.show(error.message);
    }
    this.submit.disabled = false;
  }

  request(drop) {
    const form = new FormData();
    const append = (name, value) => form.append(name, JSON.stringify(value));
    append("drop", drop);
    append("measured", this.rows.values());
    append("vary", this.vary.chosen());
    if (this.record?.file) {
      form.append("file", this.record.file);
      append("options", this.record.options);
    }
    return form;
  }

  takeBack() {
    this.store.set({ drop: this.before });
    this.undo.hidden = true;
    this.outcome.replaceChildren();
    write(this.status, t("The drop is as it was."));
    this.submit.focus();
  }
}

/** Return a drop of one ball alone; its law can lose energy, as one ball alone is measured for its loss. */
async function aloneDrop(api, { laws, lossy_law: lossy }, drop, ball) {
  const own = drop.contacts[ball];
  const contact = lossOf(laws, own) ? own : await converted(api, lossy, drop, ball, START);
  const next = { ...drop, balls: [drop.balls[ball]], contacts: [contact], gaps: [] };
  if (drop.velocities) next.velocities = [drop.velocities[ball]];
  return next;
}

/** Return a key that changes when the form needs other choices. */
function shapeOf({ balls, contacts }) {
  return JSON.stringify([balls.map(({ name }) => name), contacts.map(({ law }) => law)]);
}
