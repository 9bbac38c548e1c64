// Creates SVG and HTML elements. Data is only set as attributes and text, never as markup.

const SVG = "http://www.w3.org/2000/svg";

export function svg(tag, attributes = {}, children = []) {
  return fill(document.createElementNS(SVG, tag), attributes, children);
}

export function html(tag, attributes = {}, children = []) {
  return fill(document.createElement(tag), attributes, children);
}

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name === "text") element.textContent = value;
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children);
  return element;
}

/** Moves an element to the front of a layer. Moving it in the DOM drops the focus, which is restored. */
export function bringToFront(part, layer) {
  const focused = part.getRootNode().activeElement === part;
  layer.append(part);
  if (focused) part.focus({ preventScroll: true });
}
