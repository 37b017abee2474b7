/** Which language the page is in: that of its address, else the first of the browser's that there is, else English. */

/** The languages, as `[code, own name]`. */
export const LANGUAGES = [
  ["en", "English"],
  ["de", "Deutsch"],
  ["fr", "Français"],
  ["es", "Español"],
];

/** Return whether there is a language of this code. */
export function isLanguage(code) {
  return LANGUAGES.some(([own]) => own === code);
}

/** Return the code of the language that an address's fragment and a browser's list of languages ask for. */
export function chosen(fragment, browser) {
  const asked = /(?:^#?|&)lang=(\w+)/.exec(fragment)?.[1];
  if (isLanguage(asked)) return asked;
  return browser.map((one) => one.slice(0, 2).toLowerCase()).find(isLanguage) ?? "en";
}

/** The code of the page's language; a worker and node speak English. */
export const language = typeof document === "undefined" ? "en" : chosen(location.hash, navigator.languages ?? []);
