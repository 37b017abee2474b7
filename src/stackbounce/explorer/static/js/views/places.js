/** Where others find this page: its addresses in the network, with a QR code for phones. */

import { h, s } from "../dom.js";
import { t } from "../words/language.js";

const BORDER = 3; // modules of white around a code

/** Return what shows the places in an element; it stays hidden where the page is for this machine alone. */
export function placesIn(element, api) {
  let asked = false;
  return async () => {
    if (asked) return;
    asked = true;
    try {
      const places = await api.places();
      if (places.length === 0) return;
      element.replaceChildren(
        h("p", { class: "note", text: t("Others on the same network can open:") }),
        ...places.map(({ address }) => h("p", { class: "place", text: address })),
        picture(places[0]),
      );
      element.hidden = false;
    } catch {
      asked = false; // asked again when the box is next opened
    }
  };
}

/** Draw a QR code: dark squares on white, in the light and in the dark. */
function picture({ address, code }) {
  const side = code.length + 2 * BORDER;
  const squares = code.flatMap((row, y) => [...row].map((bit, x) => (bit === "1" ? `M${x + BORDER} ${y + BORDER}h1v1h-1z` : "")));
  const svg = s("svg", { class: "code", role: "img", viewBox: `0 0 ${side} ${side}`, "aria-label": t("QR code of {address}", { address }) });
  svg.append(s("rect", { width: side, height: side, fill: "#fff" }), s("path", { d: squares.join(""), fill: "#000", "shape-rendering": "crispEdges" }));
  return svg;
}
