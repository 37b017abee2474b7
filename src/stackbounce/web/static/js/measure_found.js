/** What a file is, and what was found in it, in words and as a table. */

import { h } from "./dom.js";
import { table } from "./fit_words.js";
import { measured } from "./quantity.js";
import { capital } from "./words.js";

/** Return what is told about a file: what it holds, who wrote it, why, and what is unsure. */
export function recognised({ file, format, why, doubt, holds }) {
  return [
    h("p", {}, h("b", { text: file }), ` holds a ${holds} (${format}).`),
    h("p", { class: "note", text: sentence(why) }),
    doubt ? h("p", { class: "doubt", text: `Unsure: ${doubt}.` }) : null,
  ].filter(Boolean);
}

/** Return what was found, with what can be taken over into the drop. */
export function foundIn({ found, notes }, store) {
  const speed = found.find(({ name, value }) => /(^|: )impact speed/.test(name) && value > 0);
  const take = () => {
    const { height, velocities, ...drop } = store.get().drop;
    store.set({ drop: { ...drop, impact_speed: Number(speed.value.toPrecision(4)) } });
  };
  return [
    h("h2", { text: "Found" }),
    table("What was found", ["What", "Value"], found.map(({ name, value, error, unit }) => [capital(name), measured(value, error, unit)])),
    notes.length ? h("ul", { class: "notes" }, notes.map((note) => h("li", { text: sentence(note) }))) : null,
    speed ? h("button", { type: "button", text: `Drop at its impact speed, ${measured(speed.value, speed.error, "m/s")}`, onclick: take }) : null,
  ].filter(Boolean);
}

function sentence(text) {
  return /[.!?]$/.test(text) || !text ? capital(text) : `${capital(text)}.`;
}
