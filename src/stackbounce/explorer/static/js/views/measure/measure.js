/** The Measure view: a file of measurements, its results, and the record over the simulated drop. */

import { button, fillFrom, write } from "../../dom.js";
import { bounceUse } from "./bounce_use.js";
import { sayProblem } from "../../set_up/fields.js";
import { FitForm } from "./fit_form.js";
import { fileDrop, showDropping } from "./file_drop.js";
import { t } from "../../words/language.js";
import { describeFile, listFindings } from "./found.js";
import { measureForm } from "./form.js";
import { Overlay } from "./overlay.js";

/** Build the view into `root`; the server lists the options of its form. */
export async function mount(root, store, api) {
  const { options } = await api.measureOptions();
  new MeasureView(root, store, api, options);
}

class MeasureView {
  constructor(root, store, api, options) {
    const parts = fillFrom(root, "measure-parts");
    Object.assign(this, { store, api, parts, file: null, newest: 0 });
    this.use = bounceUse(parts.bounceUse, store, api);
    this.fit = new FitForm(parts.fit, store, api, (answer) => this.showFitted(answer));
    this.overlay = new Overlay(parts.record, store, api, (index) => this.fit.retarget(index));
    this.form = measureForm(parts, options, () => this.ask());
    this.away = button(t("Take the record away"), () => this.takeAway(), { class: "small" });
    parts.unsaid.open = matchMedia("(min-width: 900px)").matches;
    fileDrop(parts.fileDrop, (file, known) => this.take(file, known));
    showDropping(root);
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
    this.clear();
    if (known) this.store.set({ drop: known, until: null });
    this.ask();
  }

  takeAway() {
    this.newest += 1;
    this.file = null;
    write(this.parts.recognised, "");
    this.clear();
    this.parts.choose.focus();
  }

  /** Have the file measured, with what the form says of it; the newest question counts. */
  async ask() {
    this.newest += 1;
    const mine = this.newest;
    const { file, form } = this;
    if (!file) return;
    write(this.parts.recognised, t("Reading {file} …", { file: file.name }));
    sayProblem(this.parts.fileProblem);
    try {
      const options = form.options();
      const body = new FormData();
      body.append("file", file);
      body.append("options", JSON.stringify(options));
      const answer = await this.api.measure(body);
      if (mine === this.newest) this.show(answer, { measured: answer.measured, file, options });
    } catch (error) {
      if (mine === this.newest) this.fail(error);
    }
  }

  show(answer, record) {
    this.parts.recognised.replaceChildren(...describeFile(answer), this.away);
    this.parts.found.replaceChildren(...listFindings(answer, this.store));
    this.parts.found.hidden = false;
    if (answer.doubt) this.parts.unsaid.open = true;
    this.overlay.show(answer);
    this.use.offer(answer);
    this.fit.offer(record);
  }

  fail(error) {
    write(this.parts.recognised, "");
    sayProblem(this.parts.fileProblem, error.message);
    this.parts.unsaid.open = true;
    this.clear();
  }

  showFitted(answer) {
    this.store.set({ drop: answer.drop, t: null });
    if (answer.series.length) this.overlay.show({ series: answer.series, zero: 0 });
  }

  /** Forget what was found in the file before. */
  clear() {
    this.parts.found.hidden = true;
    this.overlay.clear();
    this.use.offer(null);
    this.fit.offer(null);
  }
}
