/** What balls and contacts are called on screen, and how numbers and units are written there and read: elsewhere they are SI. */

import { nameBall } from "../model/names.js";
import { t, translated } from "./language.js";
import { LANGUAGES, language } from "./language_choice.js";

/** Return a ball's name, or its place, in the page's language. */
export function ballName(drop, ball) {
  return translated(nameBall(drop, ball));
}

/** Return what a contact lies between, such as "floor – tennis". */
export function contactName(drop, contact) {
  const lower = contact === 0 ? t("floor") : ballName(drop, contact - 1);
  return `${lower} – ${ballName(drop, contact)}`;
}

/** Return a ball's name as short as a legend of many needs it: its place, whose colour stands beside it. */
export function shortBall(drop, ball) {
  return drop.balls.length > 4 ? String(ball + 1) : ballName(drop, ball);
}

/** Return a contact's name, short where there are many. */
export function shortContact(drop, contact) {
  if (drop.balls.length <= 3) return contactName(drop, contact);
  return contact === 0 ? t("floor–1") : `${contact}–${contact + 1}`;
}

/** Return how often a contact met. */
export function count(collisions) {
  return collisions < 0 ? t("infinitely many") : String(collisions);
}

/** Return a height in mm or m, whichever reads better; a ball that goes down has none. */
export function height(value) {
  if (value === null || value === undefined) return "–";
  return value <= 0 ? "0 m" : metres(value);
}

/** Return a length in mm or m, whichever reads better. */
export function metres(value) {
  return value < 0.1 ? `${format(value * 1e3, 3)} mm` : `${format(value, 3)} m`;
}

/** Return a time of the clock: ms of an impact, s of a whole drop. */
export function moment(time, whole) {
  return whole ? `${fixed(time, 2)} s` : `${fixed(time * 1e3, 1)} ms`;
}

/** Return how fast a film shows what happens: `slow` times slower than it is. */
export function pace(slow) {
  if (Math.abs(slow - 1) < 0.02) return t("in real time");
  return slow > 1 ? t("slowed {times} times", { times: format(slow, 2) }) : t("{times} times as fast as it is", { times: format(1 / slow, 2) });
}

/** Return what happens at an event of a film. */
export function happening(drop, { what, contact, ball }) {
  if (what === "begin") return t("the beginning");
  if (what === "end") return t("the end of the film");
  if (what === "top") return t("top of {ball}", { ball: ballName(drop, ball) });
  const values = { contact: contactName(drop, contact) };
  return what === "touch" ? t("{contact} touch", values) : t("{contact} part", values);
}

/** Return a share of the energy as percent. */
export function percent(share) {
  if (share === null || share === undefined || !Number.isFinite(share)) return "–";
  return `${format(share * 100, 3)} %`;
}

/** Return what was dropped, for paper: balls and contacts from the floor up. */
export function setUp(drop) {
  const parts = drop.balls.map((ball, i) => {
    const { law, ...numbers } = drop.contacts[i];
    const given = Object.entries(numbers).map(([name, value]) => `${translated(name.replaceAll("_", " "))} ${typeof value === "number" ? format(value) : value}`);
    const gap = i > 0 && drop.gaps?.[i - 1] ? t(", gap {gap} mm", { gap: format(drop.gaps[i - 1] * 1e3) }) : "";
    return `${law === "none" ? t("no floor") : `${lawName(law)} (${given.join(", ")})${gap}`}; ${ballName(drop, i)} ${format(ball.mass * 1e3)} g`;
  });
  return t("{parts}; in SI units from the floor up.", { parts: parts.join("; ") });
}

/** Return how high a path comes once the floor has been touched. */
export function highest(times, path) {
  return path.reduce((most, value, i) => (times[i] > 0 ? Math.max(most, value) : most), 0);
}

/** Return the name of a law in words. */
export function lawName(law) {
  return translated(law.replace(/([a-z])([A-Z])/g, "$1 $2"));
}

/** Return a text of at most so many letters. */
export function shortened(text, most) {
  return text.length > most ? `${text.slice(0, most - 1)}…` : text;
}

/** Return a text with a capital first letter. */
export function capital(text) {
  return text ? text[0].toUpperCase() + text.slice(1) : "";
}

// numbers and their units

/** For each SI unit what people use, and how many SI units one of it is. */
const SHOWN = {
  kg: ["g", 1e-3],
  m: ["mm", 1e-3],
  s: ["ms", 1e-3],
  "N/m": ["kN/m", 1e3],
  J: ["mJ", 1e-3],
};

/** What one written unit is in SI, by the SI unit it belongs to. */
const WRITTEN = {
  kg: { kg: 1, g: 1e-3, mg: 1e-6, oz: 0.028349523125, lb: 0.45359237 },
  m: { m: 1, cm: 1e-2, mm: 1e-3, "µm": 1e-6, um: 1e-6, in: 0.0254, ft: 0.3048 },
  s: { s: 1, ms: 1e-3, "µs": 1e-6, us: 1e-6 },
  "m/s": { "m/s": 1, "cm/s": 1e-2, "mm/s": 1e-3, "km/h": 1 / 3.6, mph: 0.44704 },
  "m/s**2": { "m/s**2": 1, "m/s^2": 1, "m/s²": 1 },
  "N/m": { "N/m": 1, "kN/m": 1e3, "MN/m": 1e6, "N/mm": 1e3, "N/cm": 1e2 },
  "N s/m": { "N s/m": 1, "N*s/m": 1, "Ns/m": 1 },
  "s/m": { "s/m": 1 },
};

/** Whether the page's language has decimal commas. */
const COMMA = LANGUAGES.find(({ code }) => code === language).decimal === ",";

const QUANTITY = /^([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*(.*)$/i;

/** Return the unit in which people read an SI unit, and how many SI units one of it is. */
export function shownUnit(unit, large = false) {
  const [name, size] = (!large && SHOWN[unit]) || [unit, 1];
  return { unit: name, size };
}

/** Write a unit as people do: N/m**1.5 becomes N/m^1.5 with a raised exponent where there is one. */
export function pretty(unit) {
  return unit
    .replace("**exponent", "ᵖ")
    .replace("**1.5", "¹·⁵")
    .replace("**2", "²")
    .replace(" ", "\u00a0");
}

/** Return a number with about `digits` digits and no needless zeros. */
export function format(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-4) return tidy(value.toExponential(digits - 1));
  return tidy(String(Number(value.toPrecision(digits))));
}

/** Return a number with a fixed number of decimals and a true minus sign. */
export function fixed(value, decimals) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const text = value.toFixed(decimals);
  return tidy(Number(text) === 0 ? text.replace("-", "") : text);
}

/** Return a written number with the decimal mark of the page's language; no thousands are parted. */
function localized(text) {
  return COMMA ? text.replace(".", ",") : text;
}

/** Write ASCII's minus as a minus, and drop zeros of a mantissa. */
function tidy(text) {
  return localized(text.replace(/\.?0+e/, "e").replace("e+", "e").replaceAll("-", "−"));
}

/** Read what somebody typed for a field: a bare number is in the shown unit, "57 g" or "0.057 kg" as it says; NaN where it is none. */
export function read(text, unit, shown) {
  const found = QUANTITY.exec(pointed(text.trim().replaceAll("−", "-")));
  const size = found && (found[2] === "" ? shown.size : WRITTEN[unit]?.[found[2]]);
  return size ? clean(Number(found[1]) * size) : NaN;
}

/** Split "63 ± 1 cm" into `{value, error}`, each with the unit that only one has; without ± the error is null. */
export function splitError(text) {
  const plain = text.trim().replace(/^\(([^()]*)\)\s*([^()]*)$/, "$1 $2"); // (63 ± 1) cm
  const [value, error, ...more] = plain.split(/±|\+\/-/).map((part) => part.trim());
  if (error === undefined || more.length) return { value: text, error: null };
  const unit = (part) => QUANTITY.exec(pointed(part))?.[2] ?? "";
  const own = unit(value) || unit(error);
  const whole = (part) => (unit(part) ? part : `${part} ${own}`.trim());
  return { value: whole(value), error: whole(error) };
}

/**
 * Return a text with decimal points for decimal commas. Where the page's language has points, 1,000 could be either and stays
 * as it is.
 */
export function pointed(text) {
  if (COMMA) return text.replace(/(\d|^|[\s+-]),(?=\d)/g, "$1.");
  return /^[+-]?[1-9]\d{0,2},\d{3}(?!\d)/.test(text) ? text : text.replace(/^([+-]?\d*),(\d+)/, "$1.$2");
}

/** Round off what binary fractions add, so that 57 g is 0.057. */
export function clean(number) {
  return Number(number.toPrecision(12));
}

/** For each SI unit: the units that are shown, the largest first, with size and symbol. */
const LADDERS = {
  s: [[1, "s"], [1e-3, "ms"], [1e-6, "µs"]],
  m: [[0.1, "m", 1], [1e-3, "mm"], [1e-6, "µm"]],
  kg: [[1, "kg"], [1e-3, "g"]],
  N: [[1e3, "kN"], [1, "N"], [1e-3, "mN"]],
  "N/m": [[1e6, "MN/m"], [1e3, "kN/m"], [1, "N/m"]],
  J: [[1, "J"], [1e-3, "mJ"]],
  V: [[1, "V"], [1e-3, "mV"]],
};

/** Return a value with its error, if it has one, and its unit: "30.00 ± 0.06 ms". */
export function formatMeasured(value, error, unit) {
  if (value === null) return "–";
  if (typeof value !== "number") return String(value);
  const size = Math.abs(value) || Math.abs(error ?? 0);
  const ladder = LADDERS[unit] ?? [];
  const [from, name, own] = ladder.find(([least]) => size >= least) ?? ladder.at(-1) ?? [1, unit];
  const factor = own ?? from;
  const written = name ? ` ${pretty(name).replace("^2", "²")}` : "";
  if (!error || !Number.isFinite(error)) return `${format(value / factor, 4)}${written}`;
  const [number, spread] = rounded(value / factor, error / factor);
  return `${number} ± ${spread}${written}`;
}

/** Return a value with its error without a unit, "6.41 ± 0.05"; null without an error. */
export function withSpread({ value, error } = {}) {
  if (typeof value !== "number" || !(error > 0)) return null;
  return rounded(value, error).join(" ± ");
}

/** Return a value and its error, rounded where the error's second digit is, or its first from 3 on. */
function rounded(value, error) {
  const digit = Math.floor(Math.log10(error));
  const decimals = error / 10 ** digit < 2.95 ? 1 - digit : -digit;
  if (Math.abs(value) >= 1e6 || decimals > 8) return [format(value, 4), format(error, 2)];
  const write = (number) => {
    const step = 10 ** -decimals;
    const text = decimals > 0 ? number.toFixed(decimals) : String(Math.round(number / step) * step);
    return localized(text.replace("-", "−"));
  };
  return [write(value), write(error)];
}
