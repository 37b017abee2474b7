/** The choices of a map: what lies along its sides, between which ends, and what it shows. */

import { button } from "../../dom.js";
import { choice } from "../../set_up/fields.js";
import { t, translated } from "../../words/language.js";
import { drawingForm } from "../drawing/form.js";
import { depends } from "../drawing/sides.js";
import { sideForm } from "../drawing/side_form.js";
import { capital } from "../../words/words.js";

/** Fill the form in an element, as `drawingForm` does; `set` hears the new settings. */
export function mapForm(element, set) {
  const fill = ({ settings, paths, shows }, { current, change }) => {
    const other = { x: settings.y.path, y: settings.x.path };
    const free = (name) => paths.filter(({ path }) => !depends(path, other[name]));
    const side = (name, title) => sideForm(`map-${name}`, title, () => current()[name], free(name), (next) => change({ [name]: next }));
    return [
      choice({
        label: t("Colour shows"),
        key: "map-show",
        groups: [["", shows.map(({ show, label }) => [show, capital(translated(label))])]],
        value: settings.show,
        set: (show) => change({ show }),
      }),
      side("x", t("Across")),
      side("y", t("Up")),
      button(t("Swap sides"), () => change({ x: current().y, y: current().x }), { "data-key": "map-swap" }),
    ];
  };
  return drawingForm(element, { name: "map", extra: ({ shows }) => shows, fill }, set);
}
