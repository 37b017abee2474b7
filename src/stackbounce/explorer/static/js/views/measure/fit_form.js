/** The form of a fit: the measured values, the numbers that vary, and the outcome. */

import { partsOf, write } from "../../dom.js";
import { aligned } from "../../model/drop.js";
import { sayProblem } from "../../set_up/fields.js";
import { describeFit, describeVerdict } from "./found.js";
import { t } from "../../words/language.js";
import { converted, lossOf } from "../../set_up/laws.js";
import { measuredRows, quantityNames, variedNumbers, whichBall } from "./fit_choices.js";

const START = 0.75; // the restitution that a fit begins with where the law lost no energy

/** The form in `root`; `fitted` hears each answer. */
export class FitForm {
  constructor(root, store, api, fitted) {
    const parts = partsOf(root);
    Object.assign(this, { store, api, fitted, parts, rows: measuredRows(parts.rows, store), vary: variedNumbers(parts.vary) });
    this.record = null; // the results of a file, {measured, file, options}
    this.shape = ""; // of the drop that the form has choices for
    this.before = null; // the drop before the fit
    this.which = whichBall(parts.which, t("Which ball?"), "alone", parts.dropAlone);
    parts.dropAlone.addEventListener("click", () => this.dropAlone());
    parts.addRow.addEventListener("click", () => this.rows.add().querySelector("select").focus());
    parts.undo.addEventListener("click", () => this.takeBack());
    root.addEventListener("submit", (event) => {
      event.preventDefault();
      this.fit();
    });
  }

  /** Take the results of a file, or null. */
  offer(record) {
    const { drop } = this.store.get();
    const measured = record?.measured ?? {};
    const isAlone = Object.keys(measured).join() === "rebound_ratios.0" && drop.balls.length > 1;
    this.record = record;
    this.parts.alone.hidden = !isAlone; // which ball it is of is asked
    if (isAlone) this.which.ask(drop);
    this.rows.fill(isAlone ? {} : measured);
    this.parts.outcome.replaceChildren();
    this.parts.undo.hidden = true;
    sayProblem(this.parts.problem);
    write(this.parts.status, "");
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
    sayProblem(this.parts.problem);
    try {
      const drop = await aloneDrop(this.api, await this.api.catalogue(), this.store.get().drop, this.which.ball());
      this.store.set({ drop });
    } catch (error) {
      sayProblem(this.parts.problem, error.message);
    }
  }

  async fit() {
    const { drop } = this.store.get();
    this.parts.submit.disabled = true;
    sayProblem(this.parts.problem);
    write(this.parts.status, t("Fitting …"));
    try {
      const answer = await this.api.fit(this.request(drop));
      this.before = drop;
      this.parts.undo.hidden = false;
      this.parts.outcome.replaceChildren(...describeFit(answer, { ...this.vary.labels(), ...quantityNames(drop) }));
      write(this.parts.status, describeVerdict(answer));
      this.fitted(answer);
    } catch (error) {
      write(this.parts.status, "");
      sayProblem(this.parts.problem, error.message);
    }
    this.parts.submit.disabled = false;
  }

  request(drop) {
    const form = new FormData();
    const append = (name, value) => form.append(name, JSON.stringify(value));
    append("drop", aligned(drop));
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
    this.parts.undo.hidden = true;
    this.parts.outcome.replaceChildren();
    write(this.parts.status, t("The drop is as it was."));
    this.parts.submit.focus();
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
