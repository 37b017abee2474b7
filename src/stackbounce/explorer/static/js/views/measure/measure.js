/** The Measure view: a file of measurements, its results, and the record over the simulated drop. */

import { h, write } from "../../dom.js";
import { bounceUse } from "./bounce_use.js";
import { fitForm } from "./fit_form.js";
import { fileDrop } from "./file_drop.js";
import { t, writeTold } from "../../words/language.js";
import { describeFile, listFindings } from "./found.js";
import { measureForm } from "./form.js";
import { Overlay } from "./overlay.js";
import { pressPlot } from "../../plots/press_plot.js";

/** Build the view into `root`; the server lists the options of its form. */
export async function mount(root, store, api) {
  const { options: offered } = await api.measureOptions();
  const said = h("div", { class: "recognised", role: "status" });
  const problem = h("p", { class: "field-error", role: "alert", hidden: true });
  const found = h("section", { class: "measure-card", "aria-label": t("What was found"), hidden: true });
  const plot = h("section", { class: "measure-card", "aria-label": t("The record and the drop"), hidden: true });
  const press = pressPlot();
  const pressed = h("section", { class: "measure-card", "aria-label": t("The press curve"), hidden: true }, press.element);
  const use = bounceUse(store, api);
  const overlay = new Overlay(plot, store, api, (index) => fit.retarget(index));
  let file = null;
  let newest = 0;

  const fit = fitForm(store, api, (answer) => {
    store.set({ drop: answer.drop, t: null });
    if (answer.series.length) overlay.show({ series: answer.series, zero: 0 });
  });
  const ask = async () => {
    newest += 1;
    const mine = newest;
    if (!file) return;
    write(said, t("Reading {file} …", { file: file.name }));
    problem.hidden = true;
    try {
      const options = form.options();
      const body = new FormData();
      body.append("file", file);
      body.append("options", JSON.stringify(options));
      for (const [name, other] of Object.entries(form.files())) body.append(name, other);
      const answer = await api.measure(body);
      if (mine !== newest) return;
      said.replaceChildren(...describeFile(answer), away);
      found.replaceChildren(...listFindings(answer, store));
      found.hidden = false;
      if (answer.doubt) unsaid.open = true;
      overlay.show(answer);
      showPress(answer.branches);
      use.offer(answer);
      fit.offer({ measured: answer.measured, file, options });
    } catch (error) {
      if (mine !== newest) return;
      write(said, "");
      writeTold(problem, error.message);
      problem.hidden = false;
      unsaid.open = true;
      found.hidden = true;
      clear();
    }
  };
  const showPress = (branches) => {
    pressed.hidden = branches.length === 0;
    press.show(branches);
  };
  const clear = () => {
    overlay.clear();
    showPress([]);
    use.offer(null);
    fit.offer(null);
  };
  const away = h("button", {
    type: "button",
    class: "small",
    text: t("Take the record away"),
    onclick: () => {
      newest += 1;
      file = null;
      write(said, "");
      found.hidden = true;
      clear();
      drop.querySelector("button")?.focus();
    },
  });
  const form = measureForm(offered, ask);
  const take = (given, known) => {
    file = given;
    found.hidden = true; // it is of the file before
    clear();
    if (known) store.set({ drop: known, until: null });
    ask();
  };
  const drop = fileDrop(root, take);
  const unsaid = h(
    "details",
    { class: "measure-card", open: matchMedia("(min-width: 900px)").matches },
    h("summary", {}, h("h2", { text: t("What the file does not say") })),
    form.element,
  );
  root.replaceChildren(
    h(
      "div",
      { class: "measure-in" },
      h("section", { class: "measure-card", "aria-labelledby": "measure-title" }, drop, said, problem),
      found,
      unsaid,
    ),
    h("div", { class: "measure-out" }, use.element, plot, pressed, h("section", { class: "measure-card" }, fit.element)),
  );
  fit.offer(null);
  if (store.get().file) take(store.get().file);
  store.subscribe((state, before) => {
    if (state.file && state.file !== before.file) take(state.file);
    if (state.drop !== before.drop) {
      fit.follow();
      use.follow();
    }
    if (state.result !== before.result || state.drop !== before.drop) overlay.follow();
  });
}
