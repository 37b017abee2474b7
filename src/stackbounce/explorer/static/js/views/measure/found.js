/** What a file is, and what was found in it, in words and as a table. */

import { button, h } from "../../dom.js";
import { table } from "./fit_words.js";
import { t, translated } from "../../words/language.js";
import { withError } from "../../asking/prediction.js";
import { formatMeasured } from "../../words/quantity.js";
import { capital } from "../../words/words.js";

/** Return the kind and format of a file, the evidence for them, and a doubt if there is one. */
export function describeFile({ file, format, why, doubt, holds }) {
  return [
    h("p", { text: t("{file}: {kind} ({format}).", { file, kind: translated(holds), format: translated(format) }) }),
    h("p", { class: "note", text: sentence(translated(why)) }),
    doubt ? h("p", { class: "doubt", text: t("Unsure: {doubt}.", { doubt: translated(doubt) }) }) : null,
  ].filter(Boolean);
}

/** Return the results as a table and notes, with a button to use a measured impact speed. */
export function listFindings({ found, notes }, store) {
  const speed = found.find(({ name, value, unit }) => /(^|: )impact speed/.test(name) && value > 0 && unit === "m/s");
  const take = () => {
    const { drop: before, errors } = store.get();
    const { height, velocities, ...drop } = before;
    const patch = { drop: { ...drop, impact_speed: Number(speed.value.toPrecision(4)) } };
    store.set({ ...patch, errors: withError(errors, "impact_speed", speed.error || null) });
  };
  const rows = found.map(({ name, value, error, unit }) => [capital(translated(name)), formatMeasured(value, error, unit)]);
  const parts = [h("h2", { text: t("Found") }), table(t("What was found"), [t("What"), t("Value")], rows)];
  if (notes.length) parts.push(h("ul", { class: "notes" }, notes.map((note) => h("li", { text: sentence(translated(note)) }))));
  if (speed) {
    const text = t("Drop at the {name}, {speed}", { name: translated(speed.name), speed: formatMeasured(speed.value, speed.error, "m/s") });
    parts.push(button(text, take));
  }
  return parts;
}

function sentence(text) {
  return /[.!?]$/.test(text) || !text ? capital(text) : `${capital(text)}.`;
}
