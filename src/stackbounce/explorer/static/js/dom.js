/** Building elements in one line, and finding those of the page's HTML. */

const SVG = "http://www.w3.org/2000/svg";

/**
 * Return an element: attributes by name, `on…` as listeners, `class` and `text` as they are read.
 * @param {string} tag @param {object} attributes @param {...(Node|string|null)} children
 */
export function h(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

/** Return a button that does something when it is pressed. */
export function button(text, onclick, attributes = {}) {
  return h("button", { type: "button", text, onclick, ...attributes });
}

/** Return a table in a box that scrolls, which a label names; the cells that a row lacks are empty. A region has it as its caption, too. */
export function tableBox(role, label, heads, ...rows) {
  const caption = role === "region" ? h("caption", { class: "quiet", text: label }) : null;
  const top = heads.map((text) => (text ? h("th", { scope: "col", text }) : h("td")));
  const cells = (row) => heads.map((_, i) => (i === 0 && row[0] ? h("th", { scope: "row", text: row[0] }) : h("td", { text: row[i] ?? "" })));
  const inside = h("table", {}, caption, h("thead", {}, h("tr", {}, top)), h("tbody", {}, rows.map((row) => h("tr", {}, cells(row)))));
  return h("div", { class: "scroll", tabindex: 0, role, "aria-label": label }, inside);
}

/** As `h`, for SVG. */
export function s(tag, attributes = {}, ...children) {
  return fill(document.createElementNS(SVG, tag), attributes, children);
}

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name === "text") element.textContent = value;
    else if (name.startsWith("--")) element.style.setProperty(name, value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return element;
}

/** Return the elements that the page's HTML has within one, by what `data-part` calls them. */
export function partsOf(root) {
  return Object.fromEntries([...root.querySelectorAll("[data-part]")].map((part) => [part.dataset.part, part]));
}

/** Return a copy of what a template of the page's HTML holds. */
export function copyOf(template) {
  return document.getElementById(template).content.cloneNode(true);
}

/** Show in an element what a template of the page's HTML holds; returns its parts. */
export function fillFrom(root, template) {
  root.replaceChildren(copyOf(template));
  return partsOf(root);
}

/** Let an element be dragged where `may` returns true of the first event; `move` hears each event, the first one too. */
export function letDrag(element, may, move) {
  element.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || !may(event)) return;
    element.setPointerCapture(event.pointerId);
    move(event);
  });
  element.addEventListener("pointermove", (event) => element.hasPointerCapture(event.pointerId) && move(event));
}

/** Set an attribute only where it changes, so that a frame costs no needless work. */
export function put(element, name, value) {
  const text = String(value);
  if (element.getAttribute(name) !== text) element.setAttribute(name, text);
}

/** Set a text only where it changes. */
export function write(element, text) {
  if (element.textContent !== text) element.textContent = text;
}
