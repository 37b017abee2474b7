/** The tower: cards of the balls, with cards of the contacts between them. */

import { gapsOf, incidenceOf, valueAt, withSwap, withValue, withoutBall } from "./drops.js";
import { button, copyOf, h, partsOf, write } from "../dom.js";
import { NumberField, choice } from "./fields.js";
import { t, translated } from "../words/language.js";
import { isOfCatalogue } from "./restack.js";
import { ballName, contactName, format, lawName } from "../words/words.js";

const OWN = "";
const BEYOND = 1e4; // times beyond its slider's ends that a number of a law can be typed

/**
 * Return `{items, fields}` of the tower of a drop.
 * @param {object} tools `{catalogue, set(path, value), choose(ball, name), arrange(act), relaw(contact, name), measured(contact, values)}`
 */
export function towerOf(drop, tools, notes) {
  const fields = [];
  const field = (spec) => {
    const added = new NumberField({ set: tools.set, errorAt: tools.errorAt, ...spec });
    added.update(valueAt(drop, spec.path));
    fields.push(added);
    return added.element;
  };
  const items = [];
  for (let ball = drop.balls.length - 1; ball >= 0; ball -= 1) {
    items.push(ballCard(drop, ball, tools, field), contactCard(drop, ball, tools, field, notes[ball]));
  }
  return { items, fields };
}

function ballCard(drop, ball, tools, field) {
  const last = drop.balls.length - 1;
  const name = ballName(drop, ball);
  const icon = (text, title, key, disabled, act) =>
    button(text, () => tools.arrange(act), { class: "icon", "aria-label": title, title, "data-key": `${key}-${ball}`, disabled });
  const entries = (lossy) =>
    tools.catalogue.balls.filter((ball) => ball.lossy === lossy).map((ball) => [ball.name, `${translated(ball.name)}, ${format(ball.mass * 1e3)} g`]);
  const choose = choice({
    label: t("Ball {place}", { place: ball + 1 }),
    quiet: true,
    key: `ball-${ball}`,
    groups: [["", [[OWN, t("another ball")]]], [t("Balls a class owns"), entries(true)], [t("Balls of the paper"), entries(false)]],
    value: OWN,
    set: (chosen) => tools.choose(ball, chosen),
  });
  const { card, head, swatch, changed, size } = partsOf(copyOf("ball-card"));
  swatch.style.setProperty("--ball", `var(--ball-${ball % 6})`);
  head.append(
    choose,
    icon("↑", t("Move {ball} up", { ball: name }), "up", ball === last, (now) => withSwap(now, ball)),
    icon("↓", t("Move {ball} down", { ball: name }), "down", ball === 0, (now) => withSwap(now, ball - 1)),
    icon("×", t("Remove {ball}", { ball: name }), "remove", last === 0, (now) => withoutBall(now, ball)),
  );
  const follow = namer(choose.querySelector("select"), changed, drop, ball, tools);
  const rows = [field({ path: `balls.${ball}.mass`, label: t("mass"), of: name, unit: "kg", low: 1e-3, high: 2, follow })];
  if (incidenceOf(drop) === "velocities") {
    rows.push(field({ path: `velocities.${ball}`, label: t("velocity"), of: name, unit: "m/s", low: -10, high: 10, says: t("Up is positive, down negative.") }));
  }
  changed.before(...rows);
  const shown = { path: `balls.${ball}.diameter`, label: t("size"), term: t("diameter"), of: name, unit: "m", low: 0.01, high: 0.4, optional: true };
  size.dataset.key = `size-${ball}`;
  size.append(field({ ...shown, says: t("For the picture only: it changes nothing of the bounce.") }));
  return card;
}

/** Return a function that keeps a ball's name true while its mass changes. */
function namer(select, note, drop, ball, { catalogue }) {
  const own = drop.balls[ball];
  const entry = catalogue.balls.find(({ name }) => name === own.name);
  return (mass) => {
    const known = isOfCatalogue(catalogue, { name: own.name, mass });
    select.value = known ? own.name : OWN;
    write(select.options[0], known ? t("another ball") : entry ? t("{ball}, changed", { ball: translated(own.name) }) : ballName(drop, ball));
    note.hidden = known || !entry;
    if (note.hidden) return;
    const values = { ball: translated(own.name), mass: format(entry.mass * 1e3) };
    write(note, t("The {ball} of the catalogue has {mass} g. Stiffnesses do not follow the mass.", values));
  };
}

function contactCard(drop, contact, tools, field, note) {
  const law = tools.catalogue.laws.find((known) => known.law === drop.contacts[contact].law);
  const laws = tools.catalogue.laws.map(({ law: name }) => [name, lawName(name)]);
  if (contact === 0) laws.push(["none", t("no floor")]);
  const choose = choice({
    label: contactName(drop, contact),
    key: `law-${contact}`,
    groups: [["", laws]],
    value: drop.contacts[contact].law,
    set: (name) => tools.relaw(contact, name),
  });
  const rows = law ? lawFields(drop, contact, law, field) : [];
  if (contact > 0) {
    const gap = { path: `gaps.${contact - 1}`, label: t("air between"), term: t("gap"), unit: "m", low: 0, high: 0.03 };
    rows.push(field({ ...gap, of: contactName(drop, contact), says: t("How far the two are apart while they fall. 0: they touch.") }));
  }
  if (note) rows.push(h("p", { class: "note", text: translated(note) }));
  const more = law ? measuredBox(contact, law, tools) : null;
  return h("li", { class: "card contact-card" }, h("div", { class: "card-head" }, choose), rows, more);
}

/** The fields of a law: those it needs, and of the others those that the contact has. */
function lawFields(drop, contact, law, field) {
  const own = drop.contacts[contact];
  return law.fields
    .filter(({ name, low, required }) => typeof low === "number" && (required || own[name] !== undefined))
    .map(({ name, low, high, least, most, words, says, explains, unit: unitOfLaw }) => {
      const unit = unitOfLaw === "N/m**exponent" && own.exponent === 1 ? "N/m" : unitOfLaw;
      const term = says === words ? undefined : translated(says);
      const bounds = [Math.max(least, low / BEYOND), Math.min(most, high * BEYOND)];
      const spec = { label: translated(words ?? says), term, of: contactName(drop, contact), unit, low, high, bounds, says: translated(explains) };
      return field({ path: `contacts.${contact}.${name}`, ...spec });
    });
}

/** A measured restitution and contact time, to be turned into the law's constants. */
function measuredBox(contact, law, tools) {
  const values = { restitution: 0.8, contact_time: 5e-3 };
  const local = (spec) => {
    const set = (_, value) => (values[spec.name] = value);
    const field = new NumberField({ ...spec, path: `measured.${contact}.${spec.name}`, set });
    field.update(values[spec.name]);
    return field.element;
  };
  const boxes = [local({ name: "restitution", label: t("how bouncy"), term: t("restitution"), unit: "", low: 0.05, high: 1, bounds: [0.001, 1] })];
  if (!law.rigid) boxes.push(local({ name: "contact_time", label: t("contact time"), unit: "s", low: 5e-4, high: 5e-2, bounds: [1e-6, 1] }));
  const { box, about, apply } = partsOf(copyOf("measured-box"));
  box.dataset.key = `measured-${contact}`;
  write(about, `${law.formula} – ${translated(law.says)} (${law.source})`);
  about.after(...boxes);
  apply.addEventListener("click", () => tools.measured(contact, { restitution: values.restitution, contactTime: values.contact_time }));
  return box;
}

/** Return the structure of a tower without its numbers: drops of the same shape share their fields. */
export function shapeOf(drop) {
  return JSON.stringify([
    incidenceOf(drop),
    drop.balls.map(({ name }) => name ?? null),
    drop.contacts.map((contact) => [contact.law, Object.keys(contact).sort(), contact.exponent === 1]),
  ]);
}

/** Return a drop with a ball of the catalogue in a place; an own one keeps its mass without a name. */
export function withChosen(drop, ball, entry) {
  if (!entry) {
    const { name: _name, ...rest } = drop.balls[ball];
    return withValue(drop, `balls.${ball}`, rest);
  }
  const { name, mass, diameter } = entry;
  return withValue({ ...drop, gaps: gapsOf(drop) }, `balls.${ball}`, { mass, diameter, name });
}
