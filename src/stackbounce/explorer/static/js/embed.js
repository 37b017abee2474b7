/** The page in a frame of another page: with `?embed` in its address it shows stage, sentence and transport alone. */

import { write as addressOf } from "./state/address.js";
import { partsOf } from "./dom.js";

/** Whether the address asks for that. */
export const embedded = new URLSearchParams(location.search).has("embed");

/** Show what a frame has room for, and a link to the whole page with the same state. */
export function mountEmbed(root, store) {
  if (!embedded) return;
  document.body.classList.add("embedded");
  const { whole: link } = partsOf(root);
  link.hidden = false;
  const aim = () => link.setAttribute("href", `${location.href.split(/[?#]/)[0]}#${addressOf(store.get())}`);
  for (const name of ["focus", "pointerenter", "pointerdown", "click"]) link.addEventListener(name, aim);
  const stay = ({ view }) => view !== "play" && store.set({ view: "play" }); // the others have no room
  store.subscribe(stay);
  stay(store.get());
  aim();
}
