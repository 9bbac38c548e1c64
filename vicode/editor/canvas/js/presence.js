// Presence of other users: outlines of their selections in their color with their name, and their pointers.
import { pathOf } from "./edge_svg.js";
import { grow } from "./geometry.js";
import { html, svg } from "./svg.js";

const POINTER_MS = 120;
const MAX_OUTLINES = 40;
const GAP = 6;
const ARROW = "M1 1L1 15L5 11.4L7.6 17L10 15.9L7.5 10.5L13 10.2Z";

export class PresenceLayer {
  constructor(canvas) {
    this.canvas = canvas;
    this.others = [];
    this.art = svg("svg", { class: "presence", "aria-hidden": "true" });
    this.tags = html("div", { class: "tags", "aria-hidden": "true" });
    this.elements = [this.art, this.tags];
    this.placed = [];
    this.pointer = null;
    this.timer = 0;
    const { stage, viewport } = canvas;
    stage.addEventListener("pointermove", (event) => this.#pointAt(viewport.toWorld(viewport.toLocal(event))));
    stage.addEventListener("pointerleave", () => this.#pointAt(null));
  }

  /** Shows other users, each as `{name, color, items, pointer}`. */
  show(others) {
    this.others = others;
    this.canvas.frame.schedule("presence", () => {
      this.draw();
      this.canvas.emit("presence-painted", {});
    });
  }

  /** Redraws everything after a change of the users or of the scene. */
  draw() {
    this.placed = [];
    const outlines = this.others.flatMap((person) => this.#outlines(person));
    const pointers = this.others.filter((person) => person.pointer).map((person) => this.#pointerOf(person));
    this.art.replaceChildren(...outlines);
    this.tags.replaceChildren(...this.placed.map(({ element }) => element), ...pointers);
    this.viewChanged();
  }

  /** Keeps names and pointers in position while the view moves. */
  viewChanged() {
    const { x: left, y: top, k } = this.canvas.viewport;
    this.art.style.transform = `translate(${left}px, ${top}px) scale(${k})`;
    for (const { element, at } of this.placed) {
      const { x, y } = this.canvas.viewport.toScreen(at);
      element.style.transform = `translate(${Math.round(x)}px, ${Math.round(y)}px)`;
    }
  }

  dispose() {
    clearTimeout(this.timer);
  }

  #outlines(person) {
    const { scene, router } = this.canvas;
    const elements = person.items.slice(0, MAX_OUTLINES).map(({ of, id }) => scene.find(scene.keyOf(of, id))).filter(Boolean);
    const drawn = elements.filter((element) => scene.boxOf(element.key) || scene.isDrawable(element));
    return drawn.map((element, index) => {
      const area = scene.boxOf(element.key);
      const route = area ? null : router.route(element);
      const box = area && grow(area, GAP);
      if (index === 0) this.#tag(person, box ? { x: box.x + box.w, y: box.y } : route.at);
      const shape = box
        ? svg("rect", { x: box.x, y: box.y, width: box.w, height: box.h, rx: 12 + GAP })
        : svg("path", { d: pathOf(route.curve, { x: route.curve[6], y: route.curve[7] }) });
      shape.setAttribute("class", `outline person-${person.color}`);
      shape.setAttribute("data-at", element.key);
      return shape;
    });
  }

  #tag(person, at) {
    const label = html("span", { class: "tag-name", text: person.name });
    this.placed.push({ element: html("div", { class: `tag person-${person.color}` }, [label]), at });
  }

  #pointerOf(person) {
    const arrow = svg("svg", { viewBox: "0 0 16 20", width: 16, height: 20 }, [svg("path", { d: ARROW })]);
    const label = html("span", { class: "tag-name", text: person.name });
    const element = html("div", { class: `pointer person-${person.color}` }, [arrow, label]);
    this.placed.push({ element, at: person.pointer });
    return element;
  }

  /** Reports this user's latest pointer position, throttled, and only while other users are present. */
  #pointAt(point) {
    this.pointer = point && { x: Math.round(point.x), y: Math.round(point.y) };
    if (this.timer || !this.others.length) return;
    this.timer = setTimeout(() => {
      this.timer = 0;
      this.canvas.emit("pointer", { at: this.pointer });
    }, POINTER_MS);
  }
}
