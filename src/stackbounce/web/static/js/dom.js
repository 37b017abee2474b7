/** Building elements in one line. */

const SVG = "http://www.w3.org/2000/svg";

/**
 * Return an element: attributes by name, `on…` as listeners, `class` and `text` as they are read.
 * @param {string} tag @param {object} attributes @param {...(Node|string|null)} children
 */
export function h(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
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
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return element;
}

/** Set an attribute only where it changes, so that a frame costs no needless work. */
export function put(element, name, value) {
  const text = String(value);
  if (element.getAttribute(name) !== text) element.setAttribute(name, text);
}

/** Set a text only where it changes. */
export function write(element, text) {
  if (element.textContent === text) return;
  const { firstChild: only } = element;
  if (only?.nodeType === Node.TEXT_NODE && !only.nextSibling) only.data = text;
  else element.textContent = text;
}

/**
 * Make the content of an element like new children without listeners: elements of the same kind stay, and only what
 * differs is changed, which costs a browser less than new elements.
 */
export function renew(element, ...children) {
  const present = [...element.childNodes];
  children.forEach((next, i) => {
    if (i >= present.length) element.append(next);
    else if (!alter(present[i], next)) present[i].replaceWith(next);
  });
  for (const left of present.slice(children.length)) left.remove();
}

/** Make a node like another one of its kind; tell whether it is of that kind. */
function alter(node, next) {
  if (node.nodeName !== next.nodeName) return false;
  if (node.nodeType === Node.TEXT_NODE) {
    if (node.data !== next.data) node.data = next.data;
    return true;
  }
  for (const { name } of [...node.attributes]) if (!next.hasAttribute(name)) node.removeAttribute(name);
  for (const { name, value } of next.attributes) if (name !== "style") put(node, name, value);
  if (node.style.cssText !== next.style.cssText) node.style.cssText = next.style.cssText; // the content policy lets no attribute of this name be set
  renew(node, ...next.childNodes);
  return true;
}
