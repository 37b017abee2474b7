/** Share: the link, the numbers, the pictures, the scenario. */

import { write as addressOf } from "./address.js";
import { h, partsOf, write } from "../dom.js";
import { t, writeTold } from "../words/language.js";
import { placesIn } from "../views/places.js";

const STATE_COPIED = t("The state is copied: whoever has this file puts it behind the file’s address, after “.html”, and sees the same.");

/** Let the share menu in `root` do what it says. */
export function mountShare(root, store, api) {
  const { box, opener, copy, printer, said, places } = partsOf(root);
  const shared = location.protocol.startsWith("http"); // an address that others can open
  if (!shared) write(copy, t("Copy state"));
  copy.addEventListener("click", async () => {
    const state = `#${addressOf(store.get())}`;
    try {
      await navigator.clipboard.writeText(shared ? location.href.split("#")[0] + state : state);
      write(said, shared ? t("The link is copied: it opens this view again.") : STATE_COPIED);
    } catch {
      write(said, t("Copying is not allowed here; the address of this page is the link."));
    }
  });
  const save = async ({ kind, ending }) => {
    write(said, "");
    try {
      const { drop, until, errors } = store.get();
      download(await api.exportFile(kind, drop, until, errors), `stackbounce.${ending}`);
    } catch (error) {
      writeTold(said, error.message);
    }
  };
  for (const saver of root.querySelectorAll("[data-kind]")) saver.addEventListener("click", () => save(saver.dataset));
  printer.addEventListener("click", () => print());
  const loadPlaces = placesIn(places, api);
  box.addEventListener("toggle", () => box.open && loadPlaces());
  box.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    box.open = false;
    opener.focus();
  });
  document.addEventListener("pointerdown", (event) => {
    if (!box.contains(event.target)) box.open = false;
  });
}

/** Have the browser save a file. */
export function download(blob, name) {
  const url = URL.createObjectURL(blob);
  h("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
