/** The choices of a fit: the measured values that a drop is fitted to, the numbers of the drop that it varies, and which ball was measured. */

import { copyOf, h, partsOf, put, write } from "../../dom.js";
import { choice } from "../../set_up/fields.js";
import { lossOf } from "../../set_up/laws.js";
import { t, translated } from "../../words/language.js";
import { ballName, capital, contactName, pointed } from "../../words/words.js";

/** What can be measured: its name, what names the ball or contact that it is of, its words, and how a value is typed. */
const QUANTITIES = [
  ["rebound_ratios", ballName, t("rebound speed over v₀"), "1.64 ± 0.02"],
  ["rebound_speeds", ballName, t("rebound speed"), "5.8 ± 0.1 m/s"],
  ["rebound_heights", ballName, t("rebound height"), "1.72 ± 0.03 m"],
  ["durations", contactName, t("contact time"), "30.0 ± 0.2 ms"],
  ["first_touch", contactName, t("first touch"), "1.2 ± 0.1 ms"],
  ["last_release", contactName, t("last release"), "34.0 ± 0.2 ms"],
  ["collisions", contactName, t("collisions"), "1"],
  ["energy_retained", null, t("Kinetic energy retained"), "0.85 ± 0.02"],
];

/** Return `{add(), fill(measured), values(), haveClocks()}` of a list; `fill` takes texts by quantity, `values` returns them. */
export function measuredRows(element, store) {
  const add = (name = null, value = "") => {
    const row = rowOf(store.get().drop, name, value);
    element.append(row);
    return row;
  };
  const fill = (measured) => {
    element.replaceChildren();
    for (const [name, value] of Object.entries(measured)) add(name, value);
    if (!element.hasChildNodes()) add();
  };
  const values = () => {
    const typed = (row) => [row.querySelector("select").value, pointed(row.querySelector("input").value.trim())];
    const used = [...element.children].map(typed).filter(([, value]) => value !== "");
    if (used.length === 0) throw new Error(t("Type what was measured, with its error, such as 1.72 ± 0.03 m."));
    const twice = used.find(([name], i) => used.findIndex(([other]) => other === name) < i);
    if (twice) throw new Error(t("Two values are of the same quantity, {name}.", { name: twice[0] }));
    return Object.fromEntries(used);
  };
  const haveClocks = () => [...element.querySelectorAll("select")].some(({ value }) => /^(force|dur|first|last)/.test(value));
  return { add, fill, values, haveClocks };
}

/** Return a row; a force is a channel of the file. */
function rowOf(drop, name, value) {
  const isChannel = Boolean(name?.startsWith("force."));
  const names = isChannel ? forces(drop) : quantities(drop);
  const own = name ?? names[0][0];
  const example = (quantity) => QUANTITIES.find(([known]) => known === quantity.split(".")[0])?.[3];
  const { row, text, remove } = partsOf(copyOf("measured-row"));
  Object.assign(text, { value, readOnly: isChannel, placeholder: example(own) ?? "" });
  put(text, "aria-label", isChannel ? t("Channel of the file") : t("Value with its error"));
  write(remove, "×");
  remove.addEventListener("click", () => row.remove());
  const set = (chosen) => (text.placeholder = example(chosen) ?? "");
  row.prepend(choice({ label: t("Quantity"), quiet: true, groups: [["", names]], value: own, set }));
  return row;
}

/** Return the names of all that can be measured of a drop, by quantity. */
export function quantityNames(drop) {
  return Object.fromEntries([...forces(drop), ...quantities(drop)]);
}

function forces(drop) {
  return drop.balls.map((_, i) => [`force.${i}`, t("Force of {contact}", { contact: contactName(drop, i) })]);
}

function quantities(drop) {
  return QUANTITIES.flatMap(([name, placeOf, number]) =>
    placeOf ? drop.balls.map((_, i) => [`${name}.${i}`, capital(t("{number} of {place}", { number, place: placeOf(drop, i) }))]) : [[name, number]],
  );
}

/** Return `{offer(laws, drop, paths, haveClocks), chosen(), labels()}` of a fieldset; `labels` are the words of all numbers by path. */
export function variedNumbers(element) {
  let labels = {};
  const offer = (laws, drop, paths, haveClocks) => {
    const own = paths.filter(({ path }) => !path.endsWith("_ratio"));
    labels = { touch: t("First touch on the record’s clock") };
    for (const { path, label } of own) labels[path] = capital(translated(label));
    const box = ({ path }) => {
      const checked = isLikely(laws, path, drop, haveClocks);
      return h("label", { class: "check" }, h("input", { type: "checkbox", name: "vary", value: path, checked }), labels[path]);
    };
    element.replaceChildren(h("legend", { text: t("Parameters to vary") }), ...own.map(box));
  };
  const chosen = () => {
    const paths = [...element.querySelectorAll("input:checked")].map(({ value }) => value);
    if (paths.length === 0) throw new Error(t("Choose at least one parameter to vary."));
    return paths;
  };
  return { offer, chosen, labels: () => labels };
}

/** Return whether a number is usually unknown: losses are; stiffnesses are where times were measured, else only their ratio matters. */
function isLikely(laws, path, drop, haveClocks) {
  const [part, index, field] = path.split(".");
  if (part !== "contacts") return false;
  if (field === lossOf(laws, drop.contacts[index])) return true;
  const isLossless = !drop.contacts.some((contact) => lossOf(laws, contact));
  return field === "stiffness" && (haveClocks || (isLossless && Number(index) === drop.contacts.length - 1));
}

/** Offer the choice of one ball in an element, of several none is guessed; returns `{ask(drop), ball()}`. The button that needs the choice is disabled without it. */
export function whichBall(element, label, key, button) {
  let chosen = "";
  const take = (value) => {
    chosen = value;
    button.disabled = value === "";
  };
  const ask = (drop) => {
    const { balls } = drop;
    const named = balls.map((_, ball) => [String(ball), capital(ballName(drop, ball))]);
    const isOne = balls.length === 1;
    take(isOne ? "0" : "");
    const entries = isOne ? named : [["", t("Choose a ball")], ...named];
    element.replaceChildren(choice({ label, key, groups: [["", entries]], value: chosen, set: take }));
  };
  return { ask, ball: () => Number(chosen) };
}
