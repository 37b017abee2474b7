/** The views as tabs: arrows move between them, a view is built when it is first opened. */

import { hasServer } from "../origin/web.js";
import { VIEWS } from "../state/store.js";
import { ELSEWHERE } from "./measure/dropped.js";

const SHOWN = VIEWS.filter((view) => hasServer || view !== "measure");

/**
 * Show the store's view and let tabs choose it.
 * @param {object} openers by view what builds it, called once with its section
 */
export function mountTabs(store, openers) {
  const tabs = SHOWN.map((view) => document.getElementById(`tab-${view}`));
  const sections = SHOWN.map((view) => document.getElementById(view));
  const opened = new Set();
  document.getElementById("tab-measure").hidden = !hasServer;
  const show = () => {
    const { view } = store.get();
    if (!SHOWN.includes(view)) {
      store.set({ view: "play", notice: ELSEWHERE });
      return;
    }
    SHOWN.forEach((name, i) => {
      const here = name === view;
      tabs[i].setAttribute("aria-selected", String(here));
      tabs[i].tabIndex = here ? 0 : -1;
      sections[i].hidden = !here;
    });
    if (opened.has(view)) return;
    opened.add(view);
    openers[view]?.(document.getElementById(view));
  };
  tabs.forEach((tab, i) => {
    tab.addEventListener("click", () => store.set({ view: SHOWN[i] }));
    tab.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      const place = { Home: 0, End: SHOWN.length - 1 }[event.key] ?? (step && (i + step + SHOWN.length) % SHOWN.length);
      if (place === undefined) return;
      event.preventDefault();
      store.set({ view: SHOWN[place] });
      tabs[place].focus();
    });
  });
  store.watch(["view"], show);
  show();
}
