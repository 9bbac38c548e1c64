// Shows only what is within a few transitions of one node, until the user leaves it.
import { SHOW_ALL, neighborhoodName } from "./strings.js";
import { html } from "./svg.js";

export class Neighborhood {
  constructor(canvas) {
    this.canvas = canvas;
    this.center = null;
    this.steps = 0;
    this.text = html("span");
    const button = html("button", { type: "button", text: SHOW_ALL });
    button.addEventListener("click", () => this.leave());
    this.element = html("div", { class: "neighborhood", role: "status", hidden: true }, [this.text, button]);
    for (const name of ["pointerdown", "pointermove", "dblclick"]) this.element.addEventListener(name, (event) => event.stopPropagation());
  }

  get isOn() {
    return this.center !== null;
  }

  /** Shows the nodes within `steps` transitions of a node; a second time everything again. */
  toggle(key, steps) {
    if (this.center === key && this.steps === steps) return this.leave();
    const { scene } = this.canvas;
    this.view ??= this.#currentView();
    scene.hide([]);
    const shown = nodesAround(scene, key, steps);
    scene.hide([...scene.nodes.keys()].filter((node) => !shown.has(node)));
    Object.assign(this, { center: key, steps });
    this.text.textContent = neighborhoodName(scene.nodes.get(key).label, steps, shown.size, scene.nodes.size);
    this.element.hidden = false;
    this.canvas.visibilityChanged();
    this.canvas.fit();
  }

  /** Shows everything, where the view was before; returns whether anything was hidden. */
  leave() {
    if (!this.isOn) return false;
    const { scene, viewport, stage, root } = this.canvas;
    if (this.element.contains(root.activeElement)) stage.focus({ preventScroll: true });
    scene.hide([]);
    this.center = null;
    this.element.hidden = true;
    this.canvas.visibilityChanged();
    viewport.set(this.view);
    this.view = null;
    return true;
  }

  /** Shows everything if an element that is sought is hidden. */
  leaveFor({ key, source = key, target = key }) {
    const { hidden } = this.canvas.scene;
    if (hidden.has(source) || hidden.has(target)) this.leave();
  }

  #currentView() {
    const { x, y, k } = this.canvas.viewport;
    return { x, y, k };
  }
}

/** The keys of the nodes within some transitions; components and common transitions, which many states share, end a way. */
function nodesAround(scene, center, steps) {
  const found = new Set([center]);
  let border = [center];
  for (let step = 0; step < steps; step += 1) {
    const edges = border.filter((key) => key === center || scene.nodes.get(key).of === "states").flatMap((key) => scene.edgesOf(key));
    border = [];
    for (const edge of edges.filter((each) => scene.isDrawable(each))) {
      for (const key of [edge.source, edge.target]) if (!found.has(key)) border.push(key);
      found.add(edge.source).add(edge.target);
    }
  }
  return found;
}
