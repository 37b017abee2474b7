/** The form of a fit: the measured values, the numbers that vary, and the outcome. */

import { h, write } from "../../dom.js";
import { choice } from "../../set_up/fields.js";
import { describeFit } from "./fit_words.js";
import { t, translated, writeTold } from "../../words/language.js";
import { converted, lossOf } from "../../set_up/laws.js";
import { pointed } from "../../words/units.js";
import { ballName, capital, contactName } from "../../words/words.js";

const BY_BALL = {
  rebound_ratios: t("rebound speed over v₀"),
  rebound_speeds: t("rebound speed"),
  rebound_heights: t("rebound height"),
};
const BY_CONTACT = {
  durations: t("contact time"),
  first_touch: t("first touch"),
  last_release: t("last release"),
  collisions: t("collisions"),
};
const UNLIKELY = 1e-3; // the p-value below which a fit is called poor
const START = 0.75; // the restitution that a fit begins with where the law lost no energy
const EXAMPLES = {
  rebound_ratios: "1.64 ± 0.02",
  rebound_speeds: "5.8 ± 0.1 m/s",
  rebound_heights: "1.72 ± 0.03 m",
  durations: "30.0 ± 0.2 ms",
  first_touch: "1.2 ± 0.1 ms",
  last_release: "34.0 ± 0.2 ms",
  energy_retained: "0.85 ± 0.02",
  collisions: "1",
};

/**
 * Return `{element, offer(record), follow(), retarget(index)}`: `offer` takes the results of a file ({measured, file, options} or
 * null), `follow` adapts the form to the store's drop. `fitted` is called with each answer.
 */
export function fitForm(store, api, fitted) {
  const vary = h("fieldset", { class: "fit-vary" });
  const rows = h("ul", { class: "fit-rows" });
  const alonePlace = h("div");
  const aloneButton = h("button", { type: "button", text: t("Drop this ball alone"), onclick: () => dropAlone() });
  let aloneBall = "";
  const alone = h(
    "div",
    { class: "fit-alone", hidden: true },
    h("p", { text: t("The file is of one ball alone; the drop is a stack.") }),
    alonePlace,
    aloneButton,
  );
  const status = h("p", { class: "note", role: "status" });
  const problem = h("p", { class: "field-error", role: "alert", hidden: true });
  const button = h("button", { type: "submit", class: "primary", text: t("Fit") });
  const undo = h("button", { type: "button", text: t("Back to the drop before"), hidden: true });
  const outcome = h("div", { class: "fit-outcome" });
  const element = h(
    "form",
    { class: "fit", "aria-labelledby": "fit-title", autocomplete: "off" },
    h("h2", { id: "fit-title", text: t("Fit the drop to it") }),
    h(
      "fieldset",
      {},
      h("legend", { text: t("What was measured") }),
      alone,
      rows,
      h("button", { type: "button", text: t("Add a measured value"), onclick: () => addRow().querySelector("select").focus() }),
    ),
    vary,
    h("div", { class: "fit-buttons" }, button, undo),
    status,
    problem,
    outcome,
  );
  let record = null;
  let shape = "";
  let labels = {};
  let before = null;
  let known = null;
  const catalogue = async () => (known ??= await api.catalogue());

  const addRow = (name = null, value = "", channel = false) => {
    const { drop } = store.get();
    const names = channel ? forces(drop) : quantities(drop);
    const own = name ?? names[0][0];
    const text = h("input", {
      type: "text",
      class: "fit-value",
      value,
      readonly: channel,
      spellcheck: "false",
      placeholder: EXAMPLES[own.split(".")[0]],
      "aria-label": channel ? t("Channel of the file") : t("Value with its error"),
    });
    const row = h(
      "li",
      { class: "fit-row" },
      choice({
        label: t("Quantity"),
        quiet: true,
        groups: [["", names]],
        value: own,
        set: (chosen) => (text.placeholder = EXAMPLES[chosen.split(".")[0]] ?? ""),
      }),
      text,
      h("button", {
        type: "button",
        class: "icon",
        text: "×",
        "aria-label": t("Leave this out"),
        onclick: () => row.remove(),
      }),
    );
    rows.append(row);
    return row;
  };
  const offer = (next) => {
    record = next;
    rows.replaceChildren();
    const measured = Object.entries(next?.measured ?? {});
    const single = measured.length === 1 && measured[0][0] === "rebound_ratios.0" && store.get().drop.balls.length > 1;
    alone.hidden = !single;
    if (single) askWhich();
    if (!single) for (const [name, value] of measured) addRow(name, value, name.startsWith("force."));
    if (!rows.hasChildNodes()) addRow();
    outcome.replaceChildren();
    undo.hidden = true;
    problem.hidden = true;
    write(status, "");
    offerVaried();
  };
  const askWhich = () => {
    const { drop } = store.get();
    const balls = drop.balls.map((_, ball) => [String(ball), capital(ballName(drop, ball))]);
    aloneBall = "";
    aloneButton.disabled = true;
    const set = (value) => {
      aloneBall = value;
      aloneButton.disabled = value === "";
    };
    alonePlace.replaceChildren(choice({ label: t("Which ball?"), key: "alone", groups: [["", [["", t("Choose a ball")], ...balls]]], value: "", set }));
  };
  const dropAlone = async () => {
    problem.hidden = true;
    try {
      store.set({ drop: await aloneDrop(api, await catalogue(), store.get().drop, Number(aloneBall)) });
    } catch (error) {
      writeTold(problem, error.message);
      problem.hidden = false;
    }
  };
  const offerVaried = async () => {
    const { drop } = store.get();
    const { laws } = await catalogue();
    const { paths } = await api.mapPaths(drop).catch(() => ({ paths: [] }));
    if (drop !== store.get().drop) return;
    const own = paths.filter(({ path }) => !path.endsWith("_ratio"));
    const clocks = [...rows.querySelectorAll("select")].some(({ value }) => /^(force|dur|first|last)/.test(value));
    shape = shapeOf(drop);
    labels = { touch: t("First touch on the record’s clock") };
    for (const { path, label } of own) labels[path] = capital(translated(label));
    vary.replaceChildren(
      h("legend", { text: t("Parameters to vary") }),
      ...own.map(({ path }) => {
        const box = h("input", { type: "checkbox", name: "vary", value: path, checked: isLikely(laws, path, drop, clocks) });
        return h("label", { class: "check" }, box, labels[path]);
      }),
    );
  };
  const follow = () => {
    if (shapeOf(store.get().drop) !== shape) offer(record);
  };

  element.addEventListener("submit", async (event) => {
    event.preventDefault();
    const { drop } = store.get();
    button.disabled = true;
    problem.hidden = true;
    write(status, t("Fitting …"));
    try {
      const answer = await api.fit(request(drop));
      before = drop;
      undo.hidden = false;
      outcome.replaceChildren(...describeFit(answer, { ...labels, ...Object.fromEntries([...forces(drop), ...quantities(drop)]) }));
      write(status, describeVerdict(answer));
      fitted(answer);
    } catch (error) {
      write(status, "");
      writeTold(problem, error.message);
      problem.hidden = false;
    }
    button.disabled = false;
  });
  undo.addEventListener("click", () => {
    store.set({ drop: before });
    undo.hidden = true;
    outcome.replaceChildren();
    write(status, t("The drop is as it was."));
    button.focus();
  });

  const request = (drop) => {
    const form = new FormData();
    const typed = (row) => [row.querySelector("select").value, pointed(row.querySelector("input").value.trim())];
    const used = [...rows.children].map(typed).filter(([, value]) => value !== "");
    if (used.length === 0) throw new Error(t("Type what was measured, with its error, such as 1.72 ± 0.03 m."));
    const twice = used.find(([name], i) => used.findIndex(([other]) => other === name) < i);
    if (twice) throw new Error(t("Two values are of the same quantity, {name}.", { name: twice[0] }));
    const chosen = [...vary.querySelectorAll("input:checked")].map(({ value }) => value);
    if (chosen.length === 0) throw new Error(t("Choose at least one parameter to vary."));
    form.append("drop", JSON.stringify(drop));
    form.append("vary", JSON.stringify(chosen));
    form.append("measured", JSON.stringify(Object.fromEntries(used)));
    if (record?.file) {
      form.append("file", record.file);
      form.append("options", JSON.stringify(record.options));
    }
    return form;
  };
  /** Let the record be that of another ball or contact. */
  const retarget = (index) => {
    const moved = (name) => name.replace(/\.\d+$/, `.${index}`);
    offer({ ...record, measured: Object.fromEntries(Object.entries(record.measured).map(([name, value]) => [moved(name), value])) });
  };
  return { element, offer, follow, retarget };
}

/** Return one sentence on how well the fitted drop describes the measurement. */
function describeVerdict({ probability, chi_squared: squared, degrees_of_freedom: freedom }) {
  const poor = freedom < 1 ? squared > 1 : probability !== null && probability <= UNLIKELY;
  if (!poor) return t("Fitted: the drop is now the best one.");
  return t("Fitted, but not well: the drop is now the nearest one, and it does not describe what was measured.");
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

function forces(drop) {
  return drop.balls.map((_, i) => [`force.${i}`, t("Force of {contact}", { contact: contactName(drop, i) })]);
}

function quantities(drop) {
  const each = (names, of) =>
    Object.entries(names).flatMap(([name, says]) =>
      drop.balls.map((_, i) => [`${name}.${i}`, capital(t("{number} of {place}", { number: says, place: of(drop, i) }))]),
    );
  return [...each(BY_BALL, ballName), ...each(BY_CONTACT, contactName), ["energy_retained", t("Kinetic energy retained")]];
}

/** Return whether a number is usually unknown: losses are; stiffnesses are where times were measured, else only their ratio matters. */
function isLikely(laws, path, drop, clocks) {
  const [part, index, field] = path.split(".");
  if (part !== "contacts") return false;
  if (field === lossOf(laws, drop.contacts[index])) return true;
  const lossless = !drop.contacts.some((contact) => lossOf(laws, contact));
  return field === "stiffness" && (clocks || (lossless && Number(index) === drop.contacts.length - 1));
}
