/** The letters and colours of the page for canvases; colours are read from style.css, where they are defined. */

export const SMALL = 13; // px, as --type-small there
export const LETTERS = `${SMALL}px system-ui, sans-serif`;

const NAMES = ["text", "muted", "line", "paper", "card", "ball-0", "ball-1", "ball-2", "ball-3", "ball-4", "ball-5"];

/** Return the present colours by name. */
export function palette() {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(NAMES.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
}

/** Return the colour of a ball, or of the contact below it. */
export function colorOf(colors, index) {
  return colors[`ball-${index % 6}`];
}

/** Return the colours on white paper, whatever the page has now. */
export function paperPalette() {
  const { classList } = document.documentElement;
  const was = classList.contains("on-paper");
  classList.add("on-paper");
  const colors = palette();
  classList.toggle("on-paper", was);
  return colors;
}

const listeners = new Set();

/** Tell all that the colours have changed. */
export function repaint() {
  for (const listener of [...listeners]) listener();
}

/** Call a listener whenever the colours change: dark or light, for paper, and with the balls. */
export function onRepaint(listener) {
  const root = document.documentElement;
  listeners.add(listener);
  const paper = (on) => () => {
    root.classList.toggle("on-paper", on);
    listener();
  };
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", listener);
  addEventListener("beforeprint", paper(true));
  addEventListener("afterprint", paper(false));
}
