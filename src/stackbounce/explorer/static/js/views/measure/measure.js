/** The Measure view: a file of measurements, its results, and the record over the simulated drop. */

import { button, h, write } from "../../dom.js";
import { bounceUse } from "./bounce_use.js";
import { problemLine } from "../../set_up/fields.js";
import { FitForm } from "./fit_form.js";
import { fileDrop } from "./file_drop.js";
import { t } from "../../words/language.js";
import { describeFile, listFindings } from "./found.js";
import { measureForm } from "./form.js";
import { Overlay } from "./overlay.js";
import { pressPlot } from "../../plots/press_plot.js";

/** Build the view into `root`; the server lists the options of its form. */
export async function mount(root, store, api) {
  const { options } = await api.measureOptions();
  new MeasureView(root, store, api, options);
}

class MeasureView {
  constructor(root, store, api, options) {
    Object.assign(this, { store, api, file: null, newest: 0, problem: problemLine(), press: pressPlot() });
    this.said = h("div", { class: "recognised", role: "status" });
    this.found = card(t("What was found"));
    this.plot = card(t("The record and the drop"));
    this.pressed = card(t("The press curve"), this.press.element);
    this.use = bounceUse(store, api);
    this.fit = new FitForm(store, api, (answer) => this.showFitted(answer));
    this.overlay = new Overlay(this.plot, store, api, (index) => this.fit.retarget(index));
    this.form = measureForm(options, () => this.ask());
    this.drop = fileDrop(root, (file, known) => this.take(file, known));
    this.away = button(t("Take the record away"), () => this.takeAway(), { class: "small" });
    this.unsaid = h(
      "details",
      { class: "measure-card", open: matchMedia("(min-width: 900px)").matches },
      h("summary", {}, h("h2", { text: t("What the file does not say") })),
      this.form.element,
    );
    const first = h("section", { class: "measure-card", "aria-labelledby": "measure-title" }, this.drop, this.said, this.problem.element);
    const last = h("section", { class: "measure-card" }, this.fit.element);
    root.replaceChildren(
      h("div", { class: "measure-in" }, first, this.found, this.unsaid),
      h("div", { class: "measure-out" }, this.use.element, this.plot, this.pressed, last),
    );
    this.fit.offer(null);
    if (store.get().file) this.take(store.get().file);
    store.watch(["file"], (state) => state.file && this.take(state.file));
    store.watch(["drop"], () => {
      this.fit.follow();
      this.use.follow();
    });
    store.watch(["result", "drop"], () => this.overlay.follow());
  }

  /** Take a file, and the drop that is known of it. */
  take(file, known = null) {
    this.file = file;
    this.found.hidden = true; // it is of the file before
    this.clear();
    if (known) this.store.set({ drop: known, until: null });
    this.ask();
  }

  takeAway() {
    this.newest += 1;
    this.file = null;
    write(this.said, "");
    this.found.hidden = true;
    this.clear();
    this.drop.querySelector("button")?.focus();
  }

  /** Have the file measured, with what the form says of it; the newest question counts. */
  async ask() {
    this.newest += 1;
    const mine = this.newest;
    const { file, form } = this;
    if (!file) return;
    write(this.said, t("Reading {file} …", { file: file.name }));
    this.problem.show();
    try {
      const options = form.options();
      const body = new FormData();
      body.append("file", file);
      body.append("options", JSON.stringify(options));
      for (const [name, other] of Object.entries(form.files())) body.append(name, other);
      const answer = await this.api.measure(body);
      if (mine === this.newest) this.show(answer, { measured: answer.measured, file, options });
    } catch (error) {
      if (mine === this.newest) this.fail(error);
    }
  }

  show(answer, record) {
    this.said.replaceChildren(...describeFile(answer), this.away);
    this.found.replaceChildren(...listFindings(answer, this.store));
    this.found.hidden = false;
    if (answer.doubt) this.unsaid.open = true;
    this.overlay.show(answer);
    this.showPress(answer.branches);
    this.use.offer(answer);
    this.fit.offer(record);
  }

  fail(error) {
    write(this.said, "");
    this.problem.show(error.message);
    this.unsaid.open = true;
    this.found.hidden = true;
    this.clear();
  }

  showPress(branches) {
    this.pressed.hidden = branches.length === 0;
    this.press.show(branches);
  }

  showFitted(answer) {
    this.store.set({ drop: answer.drop, t: null });
    if (answer.series.length) this.overlay.show({ series: answer.series, zero: 0 });
  }

  clear() {
    this.overlay.clear();
    this.showPress([]);
    this.use.offer(null);
    this.fit.offer(null);
  }
}

function card(label, ...inside) {
  return h("section", { class: "measure-card", "aria-label": label, hidden: true }, inside);
}
