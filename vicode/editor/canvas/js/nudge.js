// Boxes moved step by step by keys. Until Python has told of the last step, what it tells of is an older one.

const LATEST_MS = 5000;
const PART_OF_STEPS = /^(Arrow|Shift$)/;

export class Nudge {
  constructor(canvas) {
    this.canvas = canvas;
    this.places = new Map();
    this.time = -Infinity;
    // Another key, such as that of undo, and whatever is done elsewhere, may put the boxes somewhere else.
    canvas.stage.addEventListener("keydown", ({ key }) => PART_OF_STEPS.test(key) || this.reset(), { capture: true });
    canvas.stage.addEventListener("blur", () => this.reset());
  }

  /** Where nodes are after a step further from where the last one led. */
  step(nodes, dx, dy) {
    if (performance.now() - this.time > LATEST_MS) this.reset();
    const before = nodes.map(({ key, x, y }) => [key, this.places.get(key) ?? { x, y }]);
    this.places = new Map(before.map(([key, { x, y }]) => [key, { x: x + dx, y: y + dy }]));
    this.time = performance.now();
    return this.places;
  }

  /** Python told of changes: nodes that stand where the last step led go on from there. */
  reconcile() {
    for (const [key, { x, y }] of this.places) {
      const data = this.canvas.scene.nodes.get(key)?.data;
      if (!data || (data.x === x && data.y === y)) this.places.delete(key);
    }
  }

  reset() {
    this.places.clear();
  }
}
