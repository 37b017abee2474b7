/** Building elements in one line. */

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
  element.append(...children.flat(Infinity).filter(isThere));
  return element;
}

function isThere(child) {
  return child !== null && child !== undefined;
}

/** Set an attribute only where it changes, so that a frame costs no needless work. */
export function put(element, name, value) {
  const text = String(value);
  if (element.getAttribute(name) !== text) element.setAttribute(name, text);
}

/** Hide an element or show it, only where that changes. */
export function hide(element, hidden) {
  if (element.hidden !== hidden) element.hidden = hidden;
}

/** Set a text only where it changes. */
export function write(element, text) {
  if (element.textContent === text) return;
  const { firstChild: only } = element;
  if (only?.nodeType === Node.TEXT_NODE && !only.nextSibling) only.data = text;
  else element.textContent = text;
}

/** Return the description of an element for `renew`, with the arguments of `h`, without listeners. */
export function d(tag, attributes = {}, ...children) {
  return described(h, tag, attributes, children);
}

/** As `d`, for SVG. */
export function ds(tag, attributes = {}, ...children) {
  return described(s, tag, attributes, children);
}

function described(make, tag, { text, ...attributes }, children) {
  const inside = text === undefined ? children.flat(Infinity).filter(isThere) : [text];
  const said = Object.entries(attributes).filter(([, value]) => isThere(value) && value !== false);
  const parts = inside.map((child) => (typeof child === "object" ? child : String(child)));
  return { make, tag, attributes: Object.fromEntries(said), children: parts };
}

/** Return a new element, or a text, that is as described. */
export function made(one) {
  if (typeof one === "string") return document.createTextNode(one);
  return one.make(one.tag, one.attributes, one.children.map(made));
}

const contents = new WeakMap(); // by element, what `renew` described last

/** Make the content of an element what descriptions say. What it was is known, and only what differs is changed. */
export function renew(element, ...children) {
  const next = children.filter(isThere);
  change(element, contents.get(element) ?? [], next);
  contents.set(element, next);
}

function change(element, before, next) {
  const present = [...element.childNodes];
  next.forEach((one, i) => {
    if (i >= before.length) element.append(made(one));
    else if (!alter(present[i], before[i], one)) present[i].replaceWith(made(one));
  });
  for (const left of present.slice(next.length)) left.remove();
}

/** Make a node, which was described, what another description says; tell whether it is one of the same kind. */
function alter(node, before, next) {
  if (typeof next === "string") {
    if (typeof before !== "string") return false;
    if (before !== next) node.data = next;
    return true;
  }
  if (before.tag !== next.tag || Object.keys(before.attributes).some((name) => !(name in next.attributes))) return false;
  const other = Object.entries(next.attributes).filter(([name, value]) => before.attributes[name] !== value);
  fill(node, Object.fromEntries(other), []);
  change(node, before.children, next.children);
  return true;
}
