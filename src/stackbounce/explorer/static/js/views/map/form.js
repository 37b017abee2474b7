/** The choices of a map: what lies along its sides, between which ends, and what it shows. */

import { h } from "../../dom.js";
import { choice } from "../../set_up/fields.js";
import { t, translated } from "../../words/language.js";
import { depends } from "./in_words.js";
import { patient, sideForm } from "../side_form.js";
import { capital } from "../../words/words.js";

/** Return `{element, update({settings, paths, shows})}`; `set` hears the new settings. */
export function mapForm(set) {
  const element = h("form", { class: "map-form view-form", "aria-label": t("What the map shows"), autocomplete: "off" });
  element.addEventListener("submit", (event) => event.preventDefault());
  let shown = "";
  const update = ({ settings, paths, shows }) => {
    const now = JSON.stringify([settings, paths.map(({ path, label }) => [path, label]), shows]);
    if (now === shown) return;
    shown = now;
    const focused = document.activeElement?.dataset?.key;
    let latest = settings; // a second choice may come before the first one is answered
    const change = (patch) => set((latest = { ...latest, ...patch }));
    const other = { x: settings.y.path, y: settings.x.path };
    const free = (name) => paths.filter(({ path }) => !depends(path, other[name]));
    const side = (name, title) => sideForm(`map-${name}`, title, () => latest[name], free(name), (next) => change({ [name]: next }));
    element.replaceChildren(
      choice({
        label: t("Colour shows"),
        key: "map-show",
        groups: [["", shows.map(({ show, label }) => [show, capital(translated(label))])]],
        value: settings.show,
        set: (show) => change({ show }),
      }),
      side("x", t("Across")),
      side("y", t("Up")),
      h("button", {
        type: "button",
        text: t("Swap sides"),
        "data-key": "map-swap",
        onclick: () => change({ x: latest.y, y: latest.x }),
      }),
    );
    if (focused?.startsWith("map-")) element.querySelector(`[data-key="${CSS.escape(focused)}"]`)?.focus();
  };
  return { element, update: patient(element, update) };
}
