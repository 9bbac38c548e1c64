// The zoom and fit buttons in the corner.
import { SELECT_SEVERAL, VIEW, ZOOM_IN, ZOOM_OUT, ZOOM_TO_100, ZOOM_TO_FIT } from "./strings.js";
import { html, svg } from "./svg.js";

const ICONS = { plus: "M3 8H13M8 3V13", minus: "M3 8H13", several: "M2.5 2.5H7.5V7.5H2.5ZM8.5 8.5H13.5V13.5H8.5Z", fit: "M2.5 6V2.5H6M10 2.5H13.5V6M13.5 10V13.5H10M6 13.5H2.5V10" };

export class Toolbar {
  constructor(canvas) {
    this.several = button("several", SELECT_SEVERAL, () => this.#collect(canvas.gestures));
    this.several.classList.add("by-touch");
    this.several.setAttribute("aria-pressed", "false");
    this.zoom = html("button", { class: "zoom", type: "button", title: ZOOM_TO_100 });
    this.element = html("div", { class: "tools", role: "toolbar", "aria-label": VIEW }, [
      this.several,
      button("plus", ZOOM_IN, () => canvas.viewport.zoomBy(1.25)),
      this.zoom,
      button("minus", ZOOM_OUT, () => canvas.viewport.zoomBy(0.8)),
      button("fit", ZOOM_TO_FIT, () => canvas.fit()),
    ]);
    const { viewport } = canvas;
    this.zoom.addEventListener("click", () => viewport.centerOn(viewport.middle().x, viewport.middle().y, 1));
    for (const name of ["pointerdown", "pointermove", "dblclick"]) this.element.addEventListener(name, (event) => event.stopPropagation());
  }

  /** Toggle that replaces the Shift key for touch: taps add to the selection, and drags on empty space draw a marquee. */
  #collect(gestures) {
    gestures.isAdditive = !gestures.isAdditive;
    this.several.setAttribute("aria-pressed", String(gestures.isAdditive));
  }

  show(zoom) {
    this.zoom.textContent = `${Math.round(zoom * 100)}%`;
    this.zoom.setAttribute("aria-label", `${this.zoom.textContent}. ${ZOOM_TO_100}`);
  }
}

function button(icon, title, job) {
  const picture = svg("svg", { viewBox: "0 0 16 16", "aria-hidden": "true" }, [svg("path", { d: ICONS[icon] })]);
  const element = html("button", { type: "button", title, "aria-label": title }, [picture]);
  element.addEventListener("click", job);
  return element;
}
