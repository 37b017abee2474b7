/** A file that is dropped anywhere on the page: it opens where files are measured, and never takes the page away. */

/** Take files that nothing else on the page takes. */
export function takeFiles(store) {
  const hasFiles = ({ dataTransfer, defaultPrevented }) => !defaultPrevented && dataTransfer?.types.includes("Files");
  addEventListener("dragover", (event) => hasFiles(event) && event.preventDefault());
  addEventListener("drop", (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    store.set({ view: "measure", file: event.dataTransfer.files[0] ?? null });
  });
}
