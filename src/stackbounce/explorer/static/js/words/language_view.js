/** The choice of the page's language, in its header. */

import { h } from "../dom.js";
import { t } from "./language.js";
import { LANGUAGES, framed, language } from "./language_choice.js";

const CHOSEN = "language chosen"; // the page's name while it is shown anew, so that the choice has the keys again

/** Build the choice into `root`; another language shows the page anew, in the state that its address holds. */
export function mountLanguage(root, store) {
  const options = LANGUAGES.map(({ code, name }) => h("option", { value: code, lang: code, text: name, selected: code === language }));
  const set = (event) => store.set({ lang: event.target.value });
  const select = h("select", { "aria-label": t("Language"), "data-key": "language", onchange: set }, options);
  root.replaceChildren(h("span", { class: "language-code", "aria-hidden": "true", text: language.toUpperCase() }), select);
  store.watch(["lang"], ({ lang }) => {
    if (lang === language) return;
    if (!framed) window.name = CHOSEN;
    location.reload();
  });
  if (window.name !== CHOSEN) return;
  window.name = "";
  const end = store.watch(["result"], () => {
    end();
    requestAnimationFrame(() => select.focus()); // the page is shown by then
  });
}
