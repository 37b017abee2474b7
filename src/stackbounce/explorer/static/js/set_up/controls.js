/** The controls: presets, how the tower comes in, and the tower. */

import { fillFrom, write } from "../dom.js";
import { GRAVITY, complete, gapsOf, incidenceOf, valueAt, withBall, withIncidence, withValue } from "./drops.js";
import { NumberField, choice, sayProblem } from "./fields.js";
import { t, translated, writeTold } from "../words/language.js";
import { isAsking } from "../words/sentence.js";
import { asMeasured, changeLaw, firstContact } from "./laws.js";
import { withError } from "../asking/prediction.js";
import { restacked } from "./restack.js";
import { withExample } from "../state/store.js";
import { shapeOf, towerOf, withChosen } from "./tower.js";

/** Build the controls into `root`; they change the store's drop and follow it. */
export function mountControls(root, store, api, catalogue) {
  const { said, general, gravity, pull, add, tower } = fillFrom(root, "controls-parts");
  const radios = [...root.querySelectorAll("[name=incidence]")];
  let fields = [];
  let falls = []; // those of them that say how the tower comes in
  let shape = "";

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
      const { drop, note } = await changeLaw(api, catalogue.laws, store.get().drop, contact, name);
      change(drop, placed(contact, note));
    });
  const measured = (contact, values) =>
    attempt(async () => {
      const { drop } = store.get();
      const { contact: changed, note } = await asMeasured(api, catalogue, drop, contact, values);
      change(withValue(drop, `contacts.${contact}`, changed), placed(contact, note));
    });
  const tools = { catalogue, set, errorAt, choose, arrange, relaw, measured };

  const rebuild = () => {
    const { drop, until, notes } = store.get();
    const focused = document.activeElement?.closest?.("[data-key], [data-path], [data-slider]");
    const open = [...root.querySelectorAll("details[open]")].map((details) => details.dataset.key);
    const built = towerOf(drop, tools, notes);
    tower.replaceChildren(...built.items);
    add.disabled = drop.balls.length >= catalogue.limits.balls;
    for (const { element } of falls) element.remove();
    falls = fallFields(drop, until, tools);
    gravity.before(...falls.map(({ element }) => element));
    for (const radio of radios) radio.checked = radio.value === incidenceOf(drop);
    pull.checked = drop.gravity > 0;
    fields = [...falls, ...built.fields];
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
    if (isAsking(store.get())) scrollTo(0, 0); // to the question
  });
  root.prepend(presets);
  add.addEventListener("click", () => arrange((now) => withBall(now, firstContact(catalogue.laws))));
  for (const radio of radios) radio.addEventListener("change", () => change(withIncidence(store.get().drop, radio.value)));
  pull.addEventListener("change", () => set("gravity", pull.checked ? GRAVITY : 0));
  root.addEventListener("keydown", ({ key }) => key === "Escape" && document.getElementById("stage-box").focus()); // for the film's keys
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

/** Return the fields on how the tower comes in. */
function fallFields(drop, until, { set, errorAt }) {
  const kind = incidenceOf(drop);
  const fields = [];
  if (kind === "height") fields.push(new NumberField({ path: "height", label: t("falls from"), unit: "m", large: true, low: 0.02, high: 10, set, errorAt }));
  if (kind === "impact_speed") fields.push(new NumberField({ path: "impact_speed", label: t("comes in at"), unit: "m/s", low: 0.1, high: 15, set, errorAt }));
  if (until !== null) fields.push(new NumberField({ path: "until", label: t("shown for"), unit: "s", large: true, low: 0.2, high: 20, set }));
  for (const field of fields) field.update(field.path === "until" ? until : drop[field.path]);
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
  const attribute = ["key", "path", "slider"].find((name) => focused.dataset[name] && focused.tagName !== "DETAILS");
  if (!attribute || focused.isConnected) return;
  root.querySelector(`[data-${attribute}="${CSS.escape(focused.dataset[attribute])}"]`)?.focus();
}
