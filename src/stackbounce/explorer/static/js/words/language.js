/**
 * The words of the page in its language. The English sentence is the key: `t("Dropped from {height}.", { height })`. A sentence
 * without a translation stays English.
 */

import { put, write } from "../dom.js";
import { language } from "./language_choice.js";
import { PARTS, PATTERNS } from "../languages/patterns.js";
import { sentences } from "../origin/web.js";

/** Return a sentence of the page, with values at its {places}. */
export function t(sentence, values = null) {
  return filled(sentences[sentence] ?? sentence, values);
}

function filled(text, values) {
  return values ? text.replace(/\{(\w+)\}/g, (whole, name) => values[name] ?? whole) : text;
}

let own = null; // sentences of the page, in its language

/** Return whether an English text has a translation, be it the same text. */
export function isTranslated(text) {
  return language === "en" || !text || toldAs(text) !== null;
}

/** Return an English text that does not come from the page: from the package, or composed by its engine. */
export function translated(text) {
  return language === "en" || !text ? text : (toldAs(text) ?? text);
}

/** Write such a text, or a sentence of the page; it is marked as English where it has no translation. */
export function writeTold(element, text) {
  write(element, translated(text));
  own ??= new Set(Object.values(sentences));
  if (isTranslated(text) || own.has(text)) element.removeAttribute("lang");
  else put(element, "lang", "en");
}

/** Translate the static texts of the page: elements with `data-t`, labels of those with `data-t-label`. */
export function translatePage() {
  document.documentElement.lang = language;
  if (language === "en") return;
  document.title = t(document.title);
  for (const root of [document, ...Array.from(document.querySelectorAll("template"), ({ content }) => content)]) {
    for (const element of root.querySelectorAll("[data-t]")) write(element, t(element.textContent.replace(/\s+/g, " ").trim()));
    for (const element of root.querySelectorAll("[data-t-label]")) put(element, "aria-label", t(element.getAttribute("aria-label")));
  }
}

const remembered = new Map();

function toldAs(text) {
  if (!remembered.has(text)) remembered.set(text, sentences[text] ?? byPattern(text));
  return remembered.get(text);
}

/** Return the translation of a text that is composed, such as "mass of tennis"; its parts may have translations, too. */
function byPattern(text, keys = PATTERNS) {
  for (const { key, names, form } of keys.map(readPattern)) {
    const found = key in sentences && form.exec(text);
    const fits = found && names.every((name, i) => name !== "number" || toldAs(found[i + 1]) !== null);
    if (fits) return filled(sentences[key], Object.fromEntries(names.map((name, i) => [name, partOf(found[i + 1])])));
  }
  return null;
}

function partOf(text) {
  return toldAs(text) ?? byPattern(text, PARTS) ?? text;
}

function readPattern(key) {
  const parts = key.split(/\{(\w+)\}/); // text, name, text, …
  const form = parts.map((part, i) => (i % 2 ? "(.+?)" : part.replace(/[.*+?^${}()|[\]\\]/g, "\\$&"))).join("");
  return { key, names: parts.filter((_, i) => i % 2), form: new RegExp(`^${form}$`, "s") };
}
