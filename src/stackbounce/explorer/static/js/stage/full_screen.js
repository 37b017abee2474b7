/** The stage in full screen, for a projector: the sentence above it, the playback below, larger texts. */

import { button, put, s } from "../dom.js";
import { t } from "../words/language.js";

/** Put the button at the stage where the browser has full screen; Escape leaves it. */
export function mountFullScreen(root, stage) {
  if (!document.fullscreenEnabled) return;
  const turn = () => {
    const isFull = document.fullscreenElement;
    if (!isFull) stage.parentElement.focus(); // where space plays
    return (isFull ? document.exitFullscreen() : root.requestFullscreen()).catch(() => null); // a frame may forbid it
  };
  const turner = button("", turn, { class: "icon full-screen" });
  turner.append(s("svg", { viewBox: "0 0 20 20", "aria-hidden": "true" }, s("path", { d: "M3 8V3H8M12 3H17V8M17 12V17H12M8 17H3V12" })));
  const show = () => {
    const name = document.fullscreenElement === root ? t("Leave full screen") : t("Full screen");
    for (const attribute of ["aria-label", "title"]) put(turner, attribute, name);
  };
  document.addEventListener("fullscreenchange", show);
  show();
  stage.append(turner);
}
