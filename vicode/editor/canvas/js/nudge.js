// Moves nodes in steps by arrow keys. Until Python has confirmed the last step, the positions it sends are outdated.

const TIMEOUT_MS = 5000;
const PART_OF_STEPS = /^(Arrow|Shift$)/;

export class Nudge {
  constructor(canvas) {
    this.canvas = canvas;
    this.places = new Map();
    this.time = -Infinity;
    // Another key, such as Ctrl+Z, or an edit outside the canvas may move the nodes.
    canvas.stage.addEventListener("keydown", ({ key }) => PART_OF_STEPS.test(key) || this.reset(), { capture: true });
    canvas.stage.addEventListener("blur", () => this.reset());
  }

  /** Returns the positions after one more step from the positions of the last step. */
  step(nodes, dx, dy) {
    if (performance.now() - this.time > TIMEOUT_MS) this.reset();
    const before = nodes.map(({ key, x, y }) => [key, this.places.get(key) ?? { x, y }]);
    this.places = new Map(before.map(([key, { x, y }]) => [key, { x: x + dx, y: y + dy }]));
    this.time = performance.now();
    return this.places;
  }

  /** Called after changes by Python: forgets the nodes whose last step is confirmed. */
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
