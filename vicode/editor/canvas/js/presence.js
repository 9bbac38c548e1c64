// The other people: what they have selected, outlined in their colour with their name, and where their pointers are.
import { pathOf } from "./edge_svg.js";
import { grow, nodeRect } from "./geometry.js";
import { keyOf } from "./scene.js";
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

  /** Shows what others are at; each is `{name, colour, items, pointer}`. */
  show(others) {
    this.others = others;
    this.canvas.frame.schedule("presence", () => {
      this.draw();
      this.canvas.emit("presence-painted", {});
    });
  }

  /** Draws everything anew: the others turned to other things, or what they are at was moved. */
  draw() {
    this.placed = [];
    const outlines = this.others.flatMap((person) => this.#outlines(person));
    const pointers = this.others.filter((person) => person.pointer).map((person) => this.#pointerOf(person));
    this.art.replaceChildren(...outlines);
    this.tags.replaceChildren(...this.placed.map(({ element }) => element), ...pointers);
    this.viewChanged();
  }

  /** Keeps names and pointers at their places while the view moves. */
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
    const things = person.items.slice(0, MAX_OUTLINES).map(({ of, id }) => scene.find(keyOf(of, id))).filter(Boolean);
    const drawn = things.filter((thing) => scene.nodes.has(thing.key) || scene.isDrawable(thing));
    return drawn.map((thing, index) => {
      const isNode = scene.nodes.has(thing.key);
      const route = isNode ? null : router.route(thing);
      const box = isNode ? grow(nodeRect(thing), GAP) : null;
      if (index === 0) this.#tag(person, box ? { x: box.x + box.w, y: box.y } : route.at);
      const shape = box
        ? svg("rect", { x: box.x, y: box.y, width: box.w, height: box.h, rx: 12 + GAP })
        : svg("path", { d: pathOf(route.curve, { x: route.curve[6], y: route.curve[7] }) });
      shape.setAttribute("class", `outline person-${person.colour}`);
      shape.setAttribute("data-at", thing.key);
      return shape;
    });
  }

  #tag(person, at) {
    const label = html("span", { class: "tag-name", text: person.name });
    this.placed.push({ element: html("div", { class: `tag person-${person.colour}` }, [label]), at });
  }

  #pointerOf(person) {
    const arrow = svg("svg", { viewBox: "0 0 16 20", width: 16, height: 20 }, [svg("path", { d: ARROW })]);
    const label = html("span", { class: "tag-name", text: person.name });
    const element = html("div", { class: `pointer person-${person.colour}` }, [arrow, label]);
    this.placed.push({ element, at: person.pointer });
    return element;
  }

  /** Tells where the own pointer is, the latest only, and only while others are here to see it. */
  #pointAt(point) {
    this.pointer = point && { x: Math.round(point.x), y: Math.round(point.y) };
    if (this.timer || !this.others.length) return;
    this.timer = setTimeout(() => {
      this.timer = 0;
      this.canvas.emit("pointer", { at: this.pointer });
    }, POINTER_MS);
  }
}
