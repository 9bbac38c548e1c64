// From pointer events to gestures: what is under the pointer decides, and movement is taken once per frame.
import { Connect, Reconnect } from "./connecting.js";
import { Marquee, Move, Pan } from "./drags.js";
import { distanceToCurve, snap } from "./geometry.js";
import { Wheel } from "./wheel.js";

const THRESHOLD = { mouse: 4, pen: 6, touch: 9 };
const DOUBLE_MS = 400;
const BORDER = 28;

export class Gestures {
  constructor(canvas) {
    this.canvas = canvas;
    this.drag = null;
    this.tool = null;
    this.touches = new Map();
    this.pinch = null;
    this.lastClick = { key: "", time: 0 };
    this.spaceHeld = false;
    this.pointer = null;
    new Wheel(canvas);
    const listen = (name, job) => canvas.stage.addEventListener(name, job);
    listen("pointerdown", (event) => this.#down(event));
    listen("pointermove", (event) => this.#move(event));
    listen("pointerup", (event) => this.#up(event));
    listen("pointercancel", () => this.cancel());
    listen("pointerleave", () => this.#hover(null));
    listen("contextmenu", (event) => event.preventDefault());
  }

  isDragging() {
    return Boolean(this.drag?.begun || this.tool);
  }

  /** Calls off whatever is under way; true when there was something. */
  cancel() {
    const busy = Boolean(this.drag || this.tool);
    if (this.drag?.begun) this.drag.gesture.cancel();
    this.tool?.cancel();
    this.drag = null;
    this.tool = null;
    this.pinch = null;
    this.lastClick = { key: "", time: 0 };
    this.touches.clear();
    this.canvas.say("");
    this.canvas.afterGesture();
    return busy;
  }

  /** Starts a connection that the next click (or Enter on a focused state) ends. */
  connectFrom(key) {
    this.cancel();
    this.tool = new Connect(this.canvas, key);
    this.tool.begin();
    this.canvas.say("Click the target, or Tab to it and press Enter. Esc ends.");
    this.canvas.handles.refresh();
  }

  /** Ends a keyboard connection at a node. */
  connectTo(key) {
    const { tool } = this;
    const target = this.canvas.scene.nodes.get(key);
    this.cancel();
    if (target) tool.connectTo(target);
  }

  sceneChanged() {
    if (this.drag?.begun) this.drag.gesture.sceneChanged?.();
    else this.tool?.sceneChanged?.();
  }

  /** Where a new thing goes: under the pointer, else in the middle. */
  spot() {
    const { viewport } = this.canvas;
    const { x, y } = this.pointer ? viewport.toWorld(this.pointer) : viewport.middle();
    return { x: snap(x), y: snap(y) };
  }

  #down(event) {
    const { canvas } = this;
    canvas.stage.focus({ preventScroll: true });
    if (event.pointerType === "touch") this.touches.set(event.pointerId, canvas.viewport.local(event));
    if (this.touches.size === 2) return this.#startPinch();
    if (this.drag || event.button === 2) return;
    event.preventDefault();
    canvas.stage.setPointerCapture(event.pointerId);
    if (this.tool) return this.#finishTool(event);
    const hit = this.#hit(event);
    const gesture = this.#choose(event, hit);
    const before = this.#press(event, hit);
    this.drag = { gesture, hit, before, begun: false, id: event.pointerId, start: this.#where(event), last: this.#where(event) };
  }

  #choose(event, hit) {
    const { canvas } = this;
    const adds = event.shiftKey || event.ctrlKey || event.metaKey;
    if (event.button === 1 || this.spaceHeld) return new Pan(canvas);
    if (hit.handle) return new Connect(canvas, hit.handle);
    if (hit.end) return new Reconnect(canvas, hit.edge, hit.end);
    if (canvas.scene.nodes.has(hit.key)) return new Move(canvas, hit.key);
    if (hit.key) return null;
    return event.pointerType === "touch" ? new Pan(canvas) : new Marquee(canvas, adds);
  }

  /** Selects what is pressed at once; answers whether it was selected before. */
  #press(event, hit) {
    const { selection } = this.canvas;
    if (!hit.key || event.button !== 0 || this.spaceHeld) return false;
    const before = selection.keys.has(hit.key);
    if (before) return true;
    const adds = event.shiftKey || event.ctrlKey || event.metaKey;
    selection.set(adds ? [...selection.keys, hit.key] : [hit.key]);
    return false;
  }

  #move(event) {
    this.pointer = this.canvas.viewport.local(event);
    if (this.touches.has(event.pointerId)) this.touches.set(event.pointerId, this.pointer);
    if (this.pinch) return this.canvas.frame.ask("drag", () => this.#pinchOn());
    const where = this.#where(event);
    if (this.tool) return this.canvas.frame.ask("drag", () => this.tool?.move(where));
    if (!this.drag) return this.canvas.frame.ask("hover", () => this.#hover(event));
    if (event.pointerId !== this.drag.id || !this.drag.gesture) return;
    this.drag.last = where;
    if (!this.drag.begun && !this.#leavesThreshold(event)) return;
    this.canvas.frame.ask("drag", () => this.#dragOn());
  }

  #leavesThreshold(event) {
    const { start, last } = this.drag;
    return Math.hypot(last.screen.x - start.screen.x, last.screen.y - start.screen.y) >= (THRESHOLD[event.pointerType] ?? 4);
  }

  #dragOn() {
    const { drag, canvas } = this;
    if (!drag) return;
    if (!drag.begun) {
      drag.begun = true;
      drag.gesture.begin(drag.start);
      canvas.handles.refresh();
    }
    const push = drag.gesture.scrolls ? this.#push(drag.last.screen) : null;
    if (push) canvas.viewport.panBy(push.x, push.y);
    drag.gesture.move({ ...drag.last, world: canvas.viewport.toWorld(drag.last.screen) });
    if (push) canvas.frame.ask("drag", () => this.#dragOn());
  }

  /** Near the border the view comes along. */
  #push({ x, y }) {
    const { width, height } = this.canvas.viewport;
    const speed = (value, size) => (value < BORDER ? (BORDER - value) / 3 : value > size - BORDER ? (size - BORDER - value) / 3 : 0);
    const push = { x: speed(x, width), y: speed(y, height) };
    return push.x || push.y ? push : null;
  }

  #up(event) {
    this.touches.delete(event.pointerId);
    if (this.pinch) return this.#endPinch();
    const { drag, canvas } = this;
    if (!drag || event.pointerId !== drag.id) return;
    canvas.frame.flush();
    this.drag = null;
    if (drag.begun) drag.gesture.end();
    else this.#click(event, drag);
    canvas.afterGesture();
  }

  #click(event, { hit, before }) {
    const { selection } = this.canvas;
    if (event.button !== 0 || this.spaceHeld || hit.handle || hit.end) return;
    const adds = event.shiftKey || event.ctrlKey || event.metaKey;
    const double = hit.key === this.lastClick.key && event.timeStamp - this.lastClick.time < DOUBLE_MS;
    this.lastClick = double ? { key: "", time: 0 } : { key: hit.key, time: event.timeStamp };
    if (adds && before) selection.toggle(hit.key);
    else if (!adds) selection.set(hit.key ? [hit.key] : []);
    if (double && !adds) this.#doubleClick(event, hit);
  }

  #doubleClick(event, hit) {
    const { canvas } = this;
    const thing = hit.key && canvas.scene.find(hit.key);
    if (thing?.of === "states") canvas.rename.start(hit.key);
    else if (thing) canvas.report("open", { of: thing.of, id: thing.id });
    else {
      const { x, y } = this.#where(event).world;
      canvas.report("create", { x: snap(x), y: snap(y) });
    }
  }

  #finishTool(event) {
    const { tool, canvas } = this;
    tool.move(this.#where(event));
    this.tool = null;
    canvas.say("");
    tool.end();
    canvas.afterGesture();
  }

  #hover(event) {
    const hit = event && !this.drag ? this.#hit(event) : { key: null };
    if (!event) this.pointer = null;
    if (this.drag) return;
    const key = hit.handle ?? (hit.end ? hit.edge : hit.key);
    if (this.canvas.selection.hover(key || null)) this.canvas.hoverChanged();
  }

  #where(event) {
    const screen = this.canvas.viewport.local(event);
    return { screen, world: this.canvas.viewport.toWorld(screen), free: event.altKey };
  }

  #hit(event) {
    const found = this.canvas.root.elementFromPoint(event.clientX, event.clientY)?.closest("[data-key],[data-handle],[data-end]");
    const { key = "", handle = null, end = null, edge = null } = found?.dataset ?? {};
    if (found || !this.canvas.far) return { key, handle, end, edge };
    return { key: this.#hitFar(this.#where(event).world), handle: null, end: null, edge: null };
  }

  /** In the overview there are no elements to ask. */
  #hitFar({ x, y }) {
    const { scene, router, viewport } = this.canvas;
    const node = scene.nodeAt(x, y);
    if (node) return node.key;
    const reach = (6 / viewport.k) ** 2;
    const near = [...scene.edgeGrid.query({ x, y, w: 0, h: 0 })].map((key) => scene.edges.get(key));
    return near.find((edge) => scene.isDrawable(edge) && distanceToCurve(router.route(edge).curve, x, y) < reach)?.key ?? "";
  }

  #startPinch() {
    if (this.drag?.begun) this.drag.gesture.cancel();
    this.drag = null;
    this.pinch = this.#span();
  }

  #pinchOn() {
    if (!this.pinch || this.touches.size < 2) return;
    const now = this.#span();
    const { viewport } = this.canvas;
    viewport.panBy(now.x - this.pinch.x, now.y - this.pinch.y);
    viewport.zoomAt(now, now.length / this.pinch.length);
    this.pinch = now;
  }

  #endPinch() {
    if (this.touches.size) return;
    this.pinch = null;
    this.canvas.afterGesture();
  }

  #span() {
    const [a, b] = [...this.touches.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, length: Math.max(1, Math.hypot(a.x - b.x, a.y - b.y)) };
  }
}
