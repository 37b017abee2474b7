/** A file that is dropped anywhere on the page: it opens where files are measured, and never takes the page away. */

import { hasServer } from "../../origin/web.js";
import { t } from "../../words/language.js";

/** What a page without a server says of measuring. */
export const ELSEWHERE = t("Reading a measurement and fitting a drop to it need stackbounce itself: install it as its documentation says, and start “stackbounce app”, which opens this page with both.");

/** Take files that nothing else on the page takes. */
export function takeFiles(store) {
  const hasFiles = ({ dataTransfer, defaultPrevented }) => !defaultPrevented && dataTransfer?.types.includes("Files");
  addEventListener("dragover", (event) => hasFiles(event) && event.preventDefault());
  addEventListener("drop", (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    store.set(hasServer ? { view: "measure", file: event.dataTransfer.files[0] ?? null } : { notice: ELSEWHERE });
  });
}
