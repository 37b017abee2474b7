/** Share: the link, the numbers, the pictures, the scenario. */

import { write as addressOf } from "./address.js";
import { button, h, write } from "../dom.js";
import { t, writeTold } from "../words/language.js";
import { placesBox } from "../views/places.js";

const FILES = [
  ["csv", t("Table (CSV)"), "csv"],
  ["png", t("Picture (PNG)"), "png"],
  ["svg", t("Picture (SVG)"), "svg"],
  ["toml", t("Scenario (TOML)"), "toml"],
  ["python", t("Python lines"), "py"],
];

const STATE_COPIED = t("The state is copied: whoever has this file puts it behind the file’s address, after “.html”, and sees the same.");

/** Build the share menu into `root`. */
export function mountShare(root, store, api) {
  const said = h("p", { class: "note", role: "status" });
  const shared = location.protocol !== "file:"; // an address that others can open
  const copy = async () => {
    const state = `#${addressOf(store.get())}`;
    try {
      await navigator.clipboard.writeText(shared ? location.href.split("#")[0] + state : state);
      write(said, shared ? t("The link is copied: it opens this view again.") : STATE_COPIED);
    } catch {
      location.hash = state;
      write(said, t("Copying is not allowed here; the address of this page is the link."));
    }
  };
  const save = async (kind, ending) => {
    write(said, "");
    try {
      const { drop, until, errors } = store.get();
      download(await api.exportFile(kind, drop, until, errors), `stackbounce.${ending}`);
    } catch (error) {
      writeTold(said, error.message);
    }
  };
  const small = (text, act) => button(text, act, { class: "small" });
  const places = placesBox(api);
  const list = h(
    "div",
    { class: "share-list" },
    small(shared ? t("Copy link") : t("Copy state"), copy),
    FILES.map(([kind, text, ending]) => small(text, () => save(kind, ending))),
    small(t("Print"), () => print()),
    said,
    places.element,
  );
  const box = h("details", { class: "share" }, h("summary", { text: t("Share") }), list);
  box.addEventListener("toggle", () => box.open && places.load());
  box.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    box.open = false;
    box.querySelector("summary").focus();
  });
  document.addEventListener("pointerdown", (event) => {
    if (!box.contains(event.target)) box.open = false;
  });
  root.replaceChildren(box);
}

/** Have the browser save a file. */
export function download(blob, name) {
  const url = URL.createObjectURL(blob);
  h("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
