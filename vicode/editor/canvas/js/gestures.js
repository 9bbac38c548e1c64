// Converts pointer events to gestures. The element under the pointer decides which; movement is handled once per frame.
import { ConnectDrag, ReconnectDrag } from "./connect_drags.js";
import { FrameDrag, MarqueeDrag, MoveDrag, PanDrag } from "./drags.js";
import { findFreePosition } from "./alignment.js";
import { distanceToCurve, distanceToOutline, snap } from "./geometry.js";
import { LabelDrag } from "./label_drag.js";
import { ConnectMode } from "./connect_mode.js";
import { CHANGE_SOURCE, CHANGE_TARGET, CONNECT, DRAW_FRAME } from "./strings.js";
import { Touch } from "./touch.js";
import { Wheel } from "./wheel.js";

const THRESHOLD = { mouse: 4, pen: 6, touch: 9 };
const DOUBLE_MS = 400;
const NO_CLICK = { key: "", time: 0 };
const BORDER = 28;
const [BORDER_REACH, SMALL_BOX] = [5, 24];

export class PointerGestures {
  constructor(canvas) {
    this.canvas = canvas;
    this.drag = null;
    this.connectMode = null;
    this.touch = new Touch(canvas, (event) => this.#longPress(event));
    this.isAdditive = false;
    this.drawsFrame = false;
    this.menuAt = null;
    this.lastClick = NO_CLICK;
    this.spaceHeld = false;
    this.pointer = null;
    new Wheel(canvas);
    const listen = (name, job) => canvas.stage.addEventListener(name, job);
    listen("pointerdown", (event) => this.#down(event));
    listen("pointermove", (event) => this.#move(event));
    listen("pointerup", (event) => this.#up(event));
    listen("pointercancel", () => this.cancel());
    // Click, key, click: the second click begins anew.
    listen("keydown", () => (this.lastClick = NO_CLICK));
    listen("pointerleave", () => this.#hover(null));
    listen("contextmenu", (event) => this.#menu(event));
    listen("dragover", (event) => event.preventDefault());
    listen("drop", (event) => this.#drop(event));
  }

  isDragging() {
    return Boolean(this.drag?.begun || this.connectMode);
  }

  /** Cancels the current gesture; returns whether there was one. */
  cancel() {
    const busy = Boolean(this.drag || this.connectMode || this.drawsFrame);
    if (this.drag?.begun) this.drag.gesture.cancel();
    this.connectMode?.cancel();
    this.drag = null;
    this.connectMode = null;
    this.drawsFrame = false;
    this.lastClick = NO_CLICK;
    this.touch.clear();
    this.canvas.showMessage("");
    this.canvas.afterGesture();
    return busy;
  }

  /** Starts to connect a node to the node that is clicked next, or that is chosen by keys. */
  connectFrom(key) {
    this.#startConnectMode(new ConnectDrag(this.canvas, key), key, CONNECT);
  }

  /** The next drag draws a rectangle around the states of a new frame. */
  drawFrame() {
    this.cancel();
    this.drawsFrame = true;
    this.canvas.showMessage(DRAW_FRAME);
  }

  /** Starts to move one end of a transition in the same way. */
  reconnect(key, end) {
    const edge = this.canvas.scene.edges.get(key);
    this.#startConnectMode(new ReconnectDrag(this.canvas, key, end), edge[end], end === "target" ? CHANGE_TARGET : CHANGE_SOURCE);
  }

  /** Enter: connects to the node that was chosen by keys. */
  finishConnect() {
    const { connectMode } = this;
    this.connectMode = null;
    this.canvas.showMessage("");
    connectMode.finish();
    this.canvas.afterGesture();
  }

  sceneChanged() {
    if (this.drag?.begun) this.drag.gesture.sceneChanged?.();
    else this.connectMode?.sceneChanged?.();
  }

  /** Free position for a new state near the open menu, else near the pointer, else near the middle of the view. */
  freePosition() {
    const { x, y } = this.pointerPosition();
    return findFreePosition(this.canvas.scene, x, y);
  }

  pointerPosition() {
    const { viewport } = this.canvas;
    const position = this.menuAt ?? this.pointer;
    return position ? viewport.toWorld(position) : viewport.middle();
  }

  #startConnectMode(gesture, from, action) {
    this.cancel();
    this.connectMode = new ConnectMode(this.canvas, gesture, from, action);
    this.connectMode.begin();
    this.canvas.handles.refresh();
  }

  #down(event) {
    const { canvas } = this;
    this.menuAt = null;
    canvas.menu.close();
    canvas.stage.focus({ preventScroll: true });
    if (this.touch.down(event)) return this.#startPinch();
    if (this.drag || event.button === 2) return;
    event.preventDefault();
    canvas.stage.setPointerCapture(event.pointerId);
    if (this.connectMode) return this.#endConnect(event);
    const hit = this.#hit(event);
    const gesture = this.#choose(event, hit);
    const before = this.#press(event, hit);
    this.drag = { gesture, hit, before, begun: false, id: event.pointerId, start: this.#where(event), last: this.#where(event) };
  }

  #choose(event, hit) {
    const { canvas } = this;
    const adds = this.#adds(event);
    if (event.button === 1 || this.spaceHeld) return new PanDrag(canvas);
    if (this.drawsFrame) return this.#startFrame();
    if (hit.handle) return new ConnectDrag(canvas, hit.handle);
    if (hit.end) return new ReconnectDrag(canvas, hit.edge, hit.end);
    const bordered = this.#borderedNode(hit, event);
    if (bordered) return new ConnectDrag(canvas, bordered.key);
    if (canvas.scene.nodes.has(hit.key) || canvas.scene.frames.has(hit.key)) return new MoveDrag(canvas, hit.key);
    if (hit.isLabel) return new LabelDrag(canvas, hit.key);
    if (hit.key) return null;
    return event.pointerType === "touch" && !this.isAdditive ? new PanDrag(canvas) : new MarqueeDrag(canvas, adds);
  }

  /** The node from whose border a transition starts here. Of a box that is drawn small, it would leave nothing to move it by. */
  #borderedNode({ key }, event) {
    const { scene, viewport } = this.canvas;
    const { world } = this.#where(event);
    const node = key ? scene.nodes.get(key) : scene.nodeAt(world.x, world.y, BORDER_REACH / viewport.k);
    if (!node || node.of === "notes" || event.pointerType === "touch" || Math.min(node.w, node.h) * viewport.k < SMALL_BOX) return null;
    return Math.abs(distanceToOutline(node, world)) * viewport.k <= BORDER_REACH ? node : null;
  }

  #startFrame() {
    this.drawsFrame = false;
    this.canvas.showMessage("");
    return new FrameDrag(this.canvas, false);
  }

  /** Whether a press adds to the selection: by a modifier key, or by the toggle button for touch. */
  #adds(event) {
    return event.shiftKey || event.ctrlKey || event.metaKey || this.isAdditive;
  }

  /** Selects the pressed element immediately; returns whether it was selected before. */
  #press(event, hit) {
    const { selection } = this.canvas;
    if (!hit.key || event.button !== 0 || this.spaceHeld) return false;
    const before = selection.keys.has(hit.key);
    if (before) return true;
    selection.set(this.#adds(event) ? [...selection.keys, hit.key] : [hit.key]);
    return false;
  }

  #move(event) {
    this.pointer = this.canvas.viewport.toLocal(event);
    this.touch.move(event);
    if (this.touch.isPinching()) return this.canvas.frame.schedule("drag", () => this.touch.pinch());
    const where = this.#where(event);
    if (this.connectMode) return this.canvas.frame.schedule("drag", () => this.connectMode?.move(where));
    if (!this.drag) return this.canvas.frame.schedule("hover", () => this.#hover(event));
    if (event.pointerId !== this.drag.id) return;
    this.drag.last = where;
    if (!this.drag.begun && !this.#leavesThreshold(event)) return;
    this.touch.cancelHold();
    this.canvas.frame.schedule("drag", () => this.#dragOn());
  }

  #leavesThreshold(event) {
    const { start, last } = this.drag;
    return Math.hypot(last.screen.x - start.screen.x, last.screen.y - start.screen.y) >= (THRESHOLD[event.pointerType] ?? 4);
  }

  #dragOn() {
    const { drag, canvas } = this;
    if (!drag?.gesture) return;
    if (!drag.begun) {
      drag.begun = true;
      drag.gesture.begin(drag.start);
      canvas.handles.refresh();
    }
    const push = drag.gesture.scrolls ? this.#autoScroll(drag.last.screen) : null;
    if (push) canvas.viewport.panBy(push.x, push.y);
    drag.gesture.move({ ...drag.last, world: canvas.viewport.toWorld(drag.last.screen) });
    if (push) canvas.frame.schedule("drag", () => this.#dragOn());
  }

  /** Distance to scroll when the pointer is near the border. */
  #autoScroll({ x, y }) {
    const { width, height } = this.canvas.viewport;
    const speed = (value, size) => (value < BORDER ? (BORDER - value) / 3 : value > size - BORDER ? (size - BORDER - value) / 3 : 0);
    const push = { x: speed(x, width), y: speed(y, height) };
    return push.x || push.y ? push : null;
  }

  #up(event) {
    if (this.touch.up(event)) return this.canvas.afterGesture();
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
    const adds = this.#adds(event);
    const double = hit.key === this.lastClick.key && event.timeStamp - this.lastClick.time < DOUBLE_MS;
    this.lastClick = double ? NO_CLICK : { key: hit.key, time: event.timeStamp };
    if (adds && before) selection.toggle(hit.key);
    else if (before) selection.choose([hit.key]);
    else if (!adds) selection.set(hit.key ? [hit.key] : []);
    if (double && !adds) this.#doubleClick(event, hit);
  }

  #doubleClick(event, hit) {
    const { canvas } = this;
    const element = hit.key && canvas.scene.find(hit.key);
    if (["states", "frames"].includes(element?.of)) canvas.rename.start(hit.key);
    else if (canvas.guard.start(hit.key)) return;
    else if (element) canvas.report("open", { item: { of: element.of, id: element.id } });
    else {
      const { x, y } = this.#where(event).world;
      canvas.rename.startNew({ x: snap(x), y: snap(y) });
    }
  }

  #endConnect(event) {
    const { connectMode, canvas } = this;
    connectMode.move(this.#where(event));
    this.connectMode = null;
    canvas.showMessage("");
    connectMode.end();
    canvas.afterGesture();
  }

  #hover(event) {
    const hit = event && !this.drag ? this.#hit(event) : { key: null };
    if (!event) this.pointer = null;
    if (this.drag) return;
    const key = hit.handle ?? (hit.end ? hit.edge : hit.key);
    this.canvas.stage.classList.toggle("connects", Boolean(event) && Boolean(this.#borderedNode(hit, event)));
    if (this.canvas.selection.hover(key || null)) this.canvas.hoverChanged();
  }

  #where(event) {
    const screen = this.canvas.viewport.toLocal(event);
    return { screen, world: this.canvas.viewport.toWorld(screen), free: event.altKey };
  }

  #hit(event) {
    const found = this.canvas.root.elementFromPoint(event.clientX, event.clientY)?.closest("[data-key],[data-handle],[data-end]");
    const { key = "", handle = null, end = null, edge = null, kind = "" } = found?.dataset ?? {};
    const isLabel = kind === "transition" && found.classList.contains("chip");
    if (found || !this.canvas.isOverview) return { key, handle, end, edge, isLabel };
    return { key: this.#hitFar(this.#where(event).world), handle: null, end: null, edge: null, isLabel: false };
  }

  /** Hit test in the overview, where no elements are mounted. */
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
  }

  /** A long press opens the menu instead of starting a drag. */
  #longPress(event) {
    if (this.drag?.begun || this.connectMode) return;
    this.drag = null;
    this.#openMenu(event);
  }

  #menu(event) {
    event.preventDefault();
    // Touch and keyboard open the menu by other events; some browsers send this one in addition.
    if (event.button === 2 && event.pointerType !== "touch") this.#openMenu(event);
  }

  #openMenu(event) {
    const { canvas } = this;
    const hit = this.#hit(event);
    const key = hit.key || hit.handle || hit.edge;
    this.cancel();
    if (!canvas.selection.keys.has(key)) canvas.selection.set(key ? [key] : []);
    this.menuAt = canvas.viewport.toLocal(event);
    canvas.menu.open(this.menuAt);
  }

  /** A design was dragged from the list of designs, as a link with its address. */
  #drop(event) {
    event.preventDefault();
    const link = event.dataTransfer?.getData("text/uri-list") ?? "";
    if (!URL.canParse(link)) return;
    const { x, y } = this.canvas.viewport.toWorld(this.canvas.viewport.toLocal(event));
    this.canvas.report("use", { address: new URL(link).pathname, x: snap(x), y: snap(y) });
  }
}
