/** Which language the page is in: that of its address, else the first of the browser's that there is, else English. */

/** The languages with the names that they have themselves; all but English have a table in `languages/`. */
export const LANGUAGES = [
  { code: "en", name: "English", decimal: "." },
  { code: "de", name: "Deutsch", decimal: "," },
  { code: "fr", name: "Français", decimal: "," },
  { code: "es", name: "Español", decimal: "," },
];

/** Return whether there is a language of this code. */
export function isLanguage(code) {
  return LANGUAGES.some((known) => known.code === code);
}

/** Return the code of the language that an address's fragment and a browser's list of languages ask for. */
export function chosen(fragment, browser) {
  const asked = /(?:^#?|&)lang=(\w+)/.exec(fragment)?.[1];
  if (isLanguage(asked)) return asked;
  return browser.map((name) => name.slice(0, 2).toLowerCase()).find(isLanguage) ?? "en";
}

/**
 * Whether the page is the text of a frame, as in a notebook. It has no address of its own there, and its name keeps its state:
 * Firefox shows nothing when such a frame is loaded anew after its history was written to.
 */
export const framed = globalThis.location?.protocol === "about:";

/** The code of the page's language; a worker and node speak English. */
export const language = typeof document === "undefined" ? "en" : chosen(framed ? window.name : location.hash, navigator.languages ?? []);
