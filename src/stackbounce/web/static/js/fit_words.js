/** What a fit found, as tables and sentences. */

import { h } from "./dom.js";
import { measured } from "./quantity.js";
import { fixed, format } from "./units.js";
import { capital } from "./words.js";

/** Return what is shown of an answer of api/fit; `labels` are what its numbers are called. */
export function told(answer, labels) {
  const { values, residuals } = answer;
  const notes = [...new Set(answer.notes)].map((note) => capital(note.replace(/[a-z_]+(\.\w+)+/g, (path) => labels[path] ?? path)));
  return [
    table("Found", ["Number", "Value"], values.map(({ path, value, error, unit }) => [labels[path] ?? capital(path), measured(value, error, unit)])),
    h("p", { text: quality(answer) }),
    residuals.length ? table("Measured and fitted", ["Quantity", "Measured", "Fitted", "Apart, in errors"], residuals.map((one) => compared(one, labels))) : null,
    notes.length ? h("ul", { class: "notes" }, notes.map((note) => h("li", { text: note }))) : null,
  ].filter(Boolean);
}

function compared({ name, measured: value, error, fitted, pull, unit }, labels) {
  return [labels[name] ?? name, measured(value, error, unit), measured(fitted, null, unit), pull === null ? "–" : fixed(pull, 1)];
}

/** Return a table with a caption for who hears it. */
export function table(caption, heads, rows) {
  const body = rows.map(([first, ...others]) =>
    h("tr", {}, h("th", { scope: "row", text: first }), others.map((text) => h("td", { text }))),
  );
  const head = h("tr", {}, heads.map((text) => h("th", { scope: "col", text })));
  return h(
    "div",
    { class: "scroll", tabindex: "0", role: "region", "aria-label": caption },
    h("table", {}, h("caption", { class: "quiet", text: caption }), h("thead", {}, head), h("tbody", {}, body)),
  );
}

/** Return in words how well the drop describes what was measured. */
function quality({ chi_squared: squared, degrees_of_freedom: freedom, probability }) {
  if (freedom < 1 && squared > 1) return "The drop does not come to what was measured, whatever varies here.";
  if (freedom < 1) return "As many numbers were varied as measured: nothing is left to check the fit by.";
  const ratio = squared / freedom;
  const told = `Chi squared is ${format(squared, 3)} for ${freedom} ${freedom === 1 ? "degree" : "degrees"} of freedom`;
  const chance = probability === null ? (ratio < 2 ? 1 : 0) : probability;
  if (ratio > 1 && chance < 1e-3) return `${told}: more than the errors allow. The model misses something, or the errors are larger.`;
  if (ratio < 1 && chance > 0.999) return `${told}: less than expected. The errors are probably smaller than told.`;
  return `${told}: as good as the errors allow.`;
}
