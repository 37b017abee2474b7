/** The controls: presets, how the tower comes in, and the tower. */

import { h, write } from "../dom.js";
import { GRAVITY, complete, gapsOf, incidenceOf, valueAt, withIncidence, withValue } from "./drops.js";
import { NumberField, check, choice, sayProblem } from "./fields.js";
import { t, translated, writeTold } from "../words/language.js";
import { asMeasured, changeLaw, lawMemory } from "./laws.js";
import { withError } from "../asking/prediction.js";
import { restacked } from "./restack.js";
import { withExample } from "../state/store.js";
import { shapeOf, towerOf, withChosen } from "./tower.js";

const INCIDENCE = [
  ["height", t("Height")],
  ["impact_speed", t("Speed")],
  ["velocities", t("Per ball")],
];

/** Build the controls into `root`; they change the store's drop and follow it. */
export function mountControls(root, store, api, catalogue) {
  const said = h("p", { class: "note", id: "preset-says" });
  const drops = h("fieldset", { class: "incidence" });
  const tower = h("section", { class: "tower-box", "aria-label": t("Tower") });
  const general = h("p", { class: "field-error", role: "alert", hidden: true });
  let fields = [];
  let shape = "";
  const laws = lawMemory();

  const change = (drop, notes = []) => store.set({ drop, notes });
  const set = (path, value, error) => {
    const { drop, errors } = store.get();
    if (path === "until") {
      store.set({ until: value });
      return;
    }
    const patch = { errors: withError(errors, path, error) };
    if (valueAt(drop, path) !== value) patch.drop = withValue({ ...drop, gaps: gapsOf(drop) }, path, value);
    store.set(patch);
  };
  const errorAt = (path) => store.get().errors[path];
  const attempt = async (act) => {
    try {
      await act();
    } catch (error) {
      store.set({ error: { detail: error.message, offline: Boolean(error.offline) } });
    }
  };
  const choose = (ball, name) => arrange((drop) => withChosen(drop, ball, catalogue.balls.find((known) => known.name === name)));
  const arrange = (act) =>
    attempt(async () => {
      const { drop } = store.get();
      change(...(await restacked(api, catalogue, drop, act(drop))));
    });
  const relaw = (contact, name) =>
    attempt(async () => {
      const { drop, note } = await changeLaw(api, catalogue.laws, store.get().drop, contact, name, laws);
      change(drop, placed(contact, note));
    });
  const measured = (contact, values) =>
    attempt(async () => {
      const { drop } = store.get();
      const { contact: changed, note } = await asMeasured(api, catalogue, drop, contact, values);
      change(withValue(drop, `contacts.${contact}`, changed), placed(contact, note));
    });
  const tools = { catalogue, set, errorAt, change, choose, arrange, relaw, measured, drop: () => store.get().drop };

  const rebuild = () => {
    const { drop, until, notes } = store.get();
    const focused = document.activeElement?.closest?.("[data-key], [data-path], [data-slider]");
    const open = [...root.querySelectorAll("details[open]")].map((details) => details.dataset.key);
    const built = towerOf(drop, tools, notes);
    tower.replaceChildren(built.element);
    fields = [...incidence(drops, drop, until, tools), ...built.fields];
    for (const key of open) tower.querySelector(`details[data-key="${key}"]`)?.setAttribute("open", "");
    focusAgain(root, focused);
  };
  const update = () => {
    const { drop, until, error, notes } = store.get();
    const now = JSON.stringify([shapeOf(drop), until === null, drop.gravity > 0, notes]);
    if (now !== shape) {
      shape = now;
      rebuild();
    } else {
      for (const field of fields) field.update(field.path === "until" ? until : valueAt(drop, field.path));
    }
    if (example && drop !== example) {
      example = null;
      presets.querySelector("select").value = "";
      write(said, "");
    }
    showError(fields, general, error);
  };

  let example = null;
  const presets = presetChoice(catalogue, (preset) => {
    writeTold(said, preset.says);
    example = complete(preset.drop);
    store.set(withExample(store.get(), example));
  });
  root.replaceChildren(presets, said, general, drops, tower);
  new IntersectionObserver(([{ isIntersecting }]) => root.classList.toggle("seen", isIntersecting)).observe(root);
  const tell = ({ notice }) => write(said, notice ?? "");
  store.watch(["notice"], tell);
  store.watch(["drop", "error", "errors", "until", "notes"], update);
  tell(store.get());
  update();
}

function placed(contact, note) {
  const notes = [];
  if (note) notes[contact] = note;
  return notes;
}

function presetChoice({ presets }, use) {
  const groups = new Map([["", [["", t("Choose an example")]]]]);
  for (const { group, name, title } of presets) {
    const own = translated(group);
    groups.set(own, [...(groups.get(own) ?? []), [name, translated(title)]]);
  }
  return choice({
    label: t("Example"),
    key: "preset",
    groups: [...groups],
    value: "",
    set: (name) => {
      const preset = presets.find((preset) => preset.name === name);
      if (preset) use(preset);
    },
  });
}

/** Fill the box on how the tower comes in; returns its fields. */
function incidence(box, drop, until, { set, errorAt, change, drop: current }) {
  const kind = incidenceOf(drop);
  const radios = INCIDENCE.map(([value, text]) => {
    const choose = { onchange: () => change(withIncidence(current(), value)) };
    const radio = h("input", { type: "radio", name: "incidence", value, checked: value === kind, "data-key": `incidence-${value}`, ...choose });
    return h("label", {}, radio, h("span", { text }));
  });
  const fields = [];
  if (kind === "height") fields.push(new NumberField({ path: "height", label: t("falls from"), unit: "m", large: true, low: 0.02, high: 10, set, errorAt }));
  if (kind === "impact_speed") fields.push(new NumberField({ path: "impact_speed", label: t("comes in at"), unit: "m/s", low: 0.1, high: 15, set, errorAt }));
  if (until !== null) fields.push(new NumberField({ path: "until", label: t("shown for"), unit: "s", large: true, low: 0.2, high: 20, set }));
  for (const field of fields) field.update(field.path === "until" ? until : drop[field.path]);
  const gravity = check(t("gravity during the impact"), drop.gravity > 0, (on) => set("gravity", on ? GRAVITY : 0), { "data-key": "gravity" });
  box.replaceChildren(
    h("legend", { text: t("The drop") }),
    h("div", { class: "segments" }, radios),
    ...fields.map((field) => field.element),
    gravity,
  );
  return fields;
}

/** Show an error beside the field that it names, else above all. */
function showError(fields, general, error) {
  const detail = error && !error.offline ? error.detail : null;
  const named = detail && fields.filter(({ path }) => mentions(detail, path)).sort((a, b) => b.path.length - a.path.length)[0];
  for (const field of fields) field.fail(field === named ? detail.slice(field.path.length).trim() : null);
  sayProblem(general, named ? null : detail);
}

function mentions(detail, path) {
  return detail.startsWith(path) && !/[\w.]/.test(detail[path.length] ?? " ");
}

function focusAgain(root, focused) {
  if (!focused) return;
  const names = ["key", "path", "slider"].filter((name) => focused.dataset[name] && focused.tagName !== "DETAILS");
  const attribute = names[0];
  if (!attribute || focused.isConnected) return;
  root.querySelector(`[data-${attribute}="${CSS.escape(focused.dataset[attribute])}"]`)?.focus();
}
