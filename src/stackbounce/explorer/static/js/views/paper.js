/** The paper: its figures that this page plays itself. */

import { button, h } from "../dom.js";
import { complete } from "../set_up/drops.js";
import { withExample } from "../state/store.js";
import { t, translated } from "../words/language.js";

/** Build the list of figures into `root`. */
export async function mount(root, store, api) {
  const { lines, presets } = await api.catalogue();
  const show = (drop, more) => () => store.set({ ...withExample(store.get(), complete(drop)), ...more });
  const entry = ({ title, says, drop }, more) => h("li", {}, button(translated(title), show(drop, more)), h("p", { class: "note", text: translated(says) }));
  const played = presets.filter(({ name }) => name.startsWith("figure-")).map((preset) => entry(preset, { view: "play" }));
  const drawn = lines.map((line) => entry(line, { view: "line", line: { x: line.x, show: "rebound_ratio" } }));
  root.firstElementChild.append(h("h3", { text: t("Figures that play here") }), h("ul", { class: "figures" }, played, drawn));
}
