/** What a file is, what was found in it, and what a fit found: as tables and sentences. */

import { button, h, tableBox } from "../../dom.js";
import { withError } from "../../asking/prediction.js";
import { t, translated } from "../../words/language.js";
import { capital, fixed, format, formatMeasured } from "../../words/words.js";

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
  const parts = [h("h2", { text: t("Found") }), tableBox("region", t("What was found"), [t("What"), t("Value")], ...rows)];
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

/** Return tables and sentences for an answer of api/fit; `labels` has a label for each path. */
export function describeFit(answer, labels) {
  const { values, residuals } = answer;
  const named = (note) => capital(translated(note).replace(/[a-z_]+(\.\w+)+/g, (path) => labels[path] ?? path));
  const notes = [...new Set(answer.notes)].map(named);
  const rows = values.map(({ path, value, error, unit }) => [labels[path] ?? capital(path), formatMeasured(value, error, unit)]);
  const parts = [tableBox("region", t("Found"), [t("Number"), t("Value")], ...rows), h("p", { text: describeQuality(answer) })];
  if (residuals.length) {
    const heads = [t("Quantity"), t("Measured"), t("Fitted"), t("Apart, in errors")];
    const compared = residuals.map(({ name, measured: value, error, fitted, pull, unit }) => {
      const apart = pull === null ? "–" : fixed(pull, 1);
      return [labels[name] ?? name, formatMeasured(value, error, unit), formatMeasured(fitted, null, unit), apart];
    });
    parts.push(tableBox("region", t("Measured and fitted"), heads, ...compared));
  }
  if (notes.length) parts.push(h("ul", { class: "notes" }, notes.map((text) => h("li", { text }))));
  return parts;
}

const UNLIKELY = 1e-3; // the p-value below which a fit is called poor

/** Return one sentence on how well the fitted drop describes the measurement. */
export function describeVerdict({ probability, chi_squared: squared, degrees_of_freedom: freedom }) {
  const isPoor = freedom < 1 ? squared > 1 : probability !== null && probability <= UNLIKELY;
  if (!isPoor) return t("Fitted: the drop is now the best one.");
  return t("Fitted, but not well: the drop is now the nearest one, and it does not describe what was measured.");
}

/** Return in words how well the drop describes what was measured. */
function describeQuality({ chi_squared: squared, degrees_of_freedom: freedom, probability }) {
  if (freedom < 1 && squared > 1) return t("No values of the varied parameters reproduce what was measured.");
  if (freedom < 1) return t("As many numbers were varied as measured: nothing is left to check the fit by.");
  const ratio = squared / freedom;
  const values = { value: format(squared, 3), freedom };
  const sentence =
    freedom === 1 ? t("Chi squared is {value} for {freedom} degree of freedom", values) : t("Chi squared is {value} for {freedom} degrees of freedom", values);
  const chance = probability === null ? (ratio < 2 ? 1 : 0) : probability;
  if (ratio > 1 && chance < UNLIKELY) return t("{sentence}: more than the errors allow. The model misses something, or the errors are larger.", { sentence });
  if (ratio < 1 && chance > 0.999) return t("{sentence}: less than expected. The errors are probably smaller than stated.", { sentence });
  return t("{sentence}: as good as the errors allow.", { sentence });
}
