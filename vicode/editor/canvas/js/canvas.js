// The canvas itself: puts the parts together, and is what Python's methods reach.
import { Clipboard } from "./clipboard.js";
import { Commands } from "./commands.js";
import { bounds, nodeRect } from "./geometry.js";
import { FrameScheduler } from "./frame_scheduler.js";
import { PointerGestures } from "./gestures.js";
import { Handles } from "./handles.js";
import { Keyboard } from "./keyboard.js";
import { LevelOfDetail } from "./level_of_detail.js";
import { Menu } from "./menu.js";
import { restoreView, saveView } from "./view_state.js";
import { Minimap } from "./minimap.js";
import { Nudge } from "./nudge.js";
import { Painter } from "./painter.js";
import { Tooltip } from "./tooltip.js";
import { PresenceLayer } from "./presence.js";
import { LayoutPreview } from "./layout_preview.js";
import { InlineRename } from "./inline_rename.js";
import { Router } from "./routing.js";
import { keyOf, Scene } from "./scene.js";
import { Selection } from "./selection.js";
import { html } from "./svg.js";
import { awaitFonts, onFontsLoaded } from "./text_metrics.js";
import { Theme } from "./theme.js";
import { Toolbar } from "./toolbar.js";
import { Viewport } from "./viewport.js";

const DOT_GAP = 20;
const DIM_MS = 120;
const TOAST_MS = 3000;

const sheet = new CSSStyleSheet();
const [look] = await Promise.all([fetch(new URL("./canvas.css", import.meta.url)), awaitFonts()]);
sheet.replaceSync(await look.text());

/** Draws into `host` (in a shadow root) and reports gestures by `emit(event, payload)`; `table` holds the commands. */
export const mountCanvas = (host, emit, table) => new Canvas(host, emit, table);

class Canvas {
  constructor(host, emit, table) {
    this.host = host;
    this.emit = emit;
    this.table = table;
    this.activeSeq = -1;
    this.clientSeq = 0;
    this.fitPending = true;
    this.frame = new FrameScheduler();
    this.scene = new Scene();
    this.router = new Router(this.scene);
    this.painter = new Painter(this.scene, this.router);
    this.#build();
    this.#wire();
    host.vicode = this.#testApi();
  }

  load(view) {
    const same = view.component === this.scene.component;
    const kept = same ? [...this.selection.keys] : [];
    this.gestures.cancel();
    this.painter.clear();
    this.router.clear();
    this.scene.load(view);
    this.nudge.reset();
    this.theme.set(view.theme);
    this.fitPending = this.fitPending || !same;
    this.selection.keys = new Set();
    this.selection.set(kept, { quiet: true });
    this.painter.mark("breakpoint", this.breakpoints ?? []);
    if (this.fitPending && this.viewport.measure()) restoreView(this);
    this.#sceneChanged();
    this.host.dataset.ready = "true";
  }

  apply(changes) {
    const change = this.scene.apply(changes);
    this.nudge.reconcile();
    this.painter.refresh(change);
    if (this.selection.prune()) this.painter.mark("selected", this.selection.keys);
    this.gestures.sceneChanged();
    this.#sceneChanged();
  }

  /** What Python wishes to be selected; it is too late when the hand selected anew before Python had heard of `seq`. */
  select(items, seq = this.clientSeq) {
    if (seq !== this.clientSeq) return;
    this.selection.set(items.map(({ of, id }) => keyOf(of, id)), { quiet: true });
  }

  centre(of, id) {
    const thing = this.scene.find(keyOf(of, id));
    if (!thing) return;
    const { x, y } = this.scene.nodes.has(thing.key) ? thing : this.scene.isDrawable(thing) ? this.router.route(thing).at : this.viewport.middle();
    this.viewport.centreOn(x, y, Math.max(this.viewport.k, 0.6));
  }

  /** Brings a thing into view as the page opens; the view of a page that was left and is come back to stays. */
  scrollToInitial(of, id) {
    return this.restoredView ? this.reveal(keyOf(of, id)) : this.centre(of, id);
  }

  fit() {
    if (!this.viewport.measure()) return;
    const extent = bounds([this.scene.extent(), this.router.extent()].filter(Boolean));
    this.fitPending = false;
    if (extent) this.viewport.fit(extent);
    else this.viewport.centreOn(0, 0, 1);
    const { x, y, k } = this.viewport;
    this.fitted = { x, y, k };
  }

  /** Shows what is selected, with the ends of its transitions. */
  zoomToSelection() {
    const keys = [...this.selection.keys].flatMap((key) => {
      const edge = this.scene.edges.get(key);
      return edge ? [edge.source, edge.target] : [key];
    });
    const extent = bounds(keys.map((key) => this.scene.nodes.get(key)).filter(Boolean).map(nodeRect));
    if (extent && this.viewport.measure()) this.viewport.fit(extent);
  }

  /** Highlights the states a running component is in; an older picture never replaces a newer one. */
  highlightActive(ids, seq, taken = []) {
    if (seq <= this.activeSeq) return;
    this.activeSeq = seq;
    this.frame.schedule("active", () => {
      this.painter.mark("active", ids.map((id) => keyOf("states", id)));
      this.painter.mark("taken", taken.map((id) => keyOf("transitions", id)));
      if (this.isOverview) this.cull();
      this.emit("ack", { seq: this.activeSeq });
    });
  }

  /** Shows signs at the things where a run is to rest. */
  setBreakpoints(items) {
    this.breakpoints = items.map(({ of, id }) => keyOf(of, id));
    this.painter.mark("breakpoint", this.breakpoints);
  }

  showLinks(flag) {
    if (this.scene.linksShown === flag) return;
    this.scene.linksShown = flag;
    this.router.clear();
    this.painter.refresh({ touched: [...this.scene.edges.keys()], gone: [], affectedNodes: [...this.scene.nodes.keys()] });
    this.#sceneChanged();
  }

  renameInPlace(id) {
    this.rename.start(keyOf("states", id));
  }

  dispose() {
    this.frame.stop();
    this.keyboard.dispose();
    this.clipboard.dispose();
    this.presence.dispose();
    this.sizes.disconnect();
    this.theme.dispose();
  }

  /** Shows other places, given as `{of, id, x, y}`, without taking them; none ends it. `stay`: the view stays too. */
  showPreview(items, stay) {
    if (items.length) this.preview.show(items.map(({ of, id, x, y }) => ({ key: keyOf(of, id), x, y })));
    else this.preview.clear({ stay });
  }

  /** Sends one gesture to Python. */
  report(kind, payload) {
    if (kind !== "move") this.nudge.reset();
    this.emit("gesture", { kind, ...payload, rev: this.scene.rev });
  }

  /** Moves boxes by a command; `how` says by which, for the name of the edit. */
  moveNodes(places, how) {
    const keys = [...places.keys()];
    const rects = keys.map((key) => nodeRect(this.scene.nodes.get(key)));
    for (const [key, { x, y }] of places) this.scene.move(key, x, y);
    this.painter.updateNodes(keys);
    this.reportMove(keys, rects, how);
    this.afterGesture();
  }

  /** Boxes were moved by hand: everything that depends on their place follows, and Python is told. */
  reportMove(keys, oldRects, how = "drag") {
    const nodes = keys.map((key) => this.scene.nodes.get(key));
    this.scene.reindex(keys);
    this.painter.refineRoutes([...oldRects, ...nodes.map(nodeRect)]);
    this.painter.mountedRect = null;
    this.report("move", { items: nodes.map(({ of, id, x, y }) => ({ of, id, x, y })), how });
    this.#sceneChanged();
  }

  /** Boxes stand elsewhere for some other reason than a hand. */
  positionsChanged(keys) {
    this.scene.reindex(keys);
    this.router.clear();
    this.painter.repositionAll();
    this.painter.mountedRect = null;
    this.#sceneChanged();
  }

  afterGesture() {
    this.painter.refineRoutes();
    this.handles.refresh();
    this.levelOfDetail.scheduleCull();
  }

  hoverChanged() {
    this.tooltip.request(this.selection.hovered);
    this.handles.refresh();
    if (this.isOverview) this.levelOfDetail.scheduleCull();
  }

  /** The selection changed, by Python's wish (`quiet`) or by hand. */
  selectionChanged(quiet) {
    this.handles.refresh();
    if (!quiet) this.report("select", { items: this.selection.items(), client_seq: ++this.clientSeq });
    this.levelOfDetail.selectionChanged();
  }

  /** Brings the mounted part up to what is seen. */
  cull() {
    this.levelOfDetail.cull();
  }

  /** Whether all is seen as a bitmap. */
  get isOverview() {
    return this.levelOfDetail.far;
  }

  /** Brings a thing into sight, and near enough to be read. */
  reveal(key) {
    const thing = this.scene.find(key);
    if (!thing) return;
    if (this.isOverview) this.centre(thing.of, thing.id);
    else if (this.scene.nodes.has(key)) this.viewport.reveal(nodeRect(thing));
    else if (this.scene.isDrawable(thing)) this.viewport.reveal({ ...this.router.route(thing).at, w: 0, h: 0 });
    this.frame.flush();
    this.cull();
  }

  /** What is lit changed: the rest steps back once the hand rests. */
  scheduleDim() {
    this.frame.debounce("dim", DIM_MS, () => (this.gestures.isDragging() ? this.scheduleDim() : this.painter.dim()));
  }

  showMessage(text) {
    this.message.textContent = text;
  }

  /** Words that go by themselves. */
  showToast(text) {
    this.showMessage(text);
    this.frame.debounce("tell", TOAST_MS, () => this.message.textContent === text && this.showMessage(""));
  }

  drawableEdges() {
    return [...this.scene.edges.values()].filter((edge) => this.scene.isDrawable(edge)).map((edge) => edge.key);
  }

  #build() {
    this.root = this.host.attachShadow({ mode: "open" });
    this.root.adoptedStyleSheets = [sheet];
    this.stage = html("div", { class: "stage", tabindex: "0", role: "application", "aria-roledescription": "state machine canvas" });
    this.root.append(this.stage);
    const colours = (name) => this.theme.colour(name);
    this.viewport = new Viewport(this.stage, this.frame);
    this.minimap = new Minimap(this.scene, this.viewport, colours);
    // What is painted last is heard first.
    const heard = { role: "group", "aria-label": "Drawing", "aria-owns": "nodes edges links" };
    this.levelOfDetail = new LevelOfDetail(this, html("div", { class: "plane", ...heard }, this.painter.svgRoots), colours);
    this.theme = new Theme(this.stage, () => this.#coloursChanged());
    this.toolbar = new Toolbar(this);
    this.selection = new Selection(this);
    this.gestures = new PointerGestures(this);
    this.handles = new Handles(this);
    this.clipboard = new Clipboard(this);
    this.commands = new Commands(this, this.table);
    this.menu = new Menu(this);
    this.rename = new InlineRename(this);
    this.preview = new LayoutPreview(this);
    this.tooltip = new Tooltip(this);
    this.presence = new PresenceLayer(this);
    this.dots = html("div", { class: "dots" });
    // Always there, as what only comes with its words is not read aloud by all screen readers.
    this.message = html("div", { class: "message", role: "status" });
    this.empty = html("div", { class: "empty", hidden: true, text: "No states yet.\nDouble click, or press S, to add the first." });
    const corner = html("div", { class: "corner" }, [this.minimap.element, this.toolbar.element]);
    const above = [this.empty, this.message, this.rename.input, corner, this.tooltip.element, this.menu.element];
    this.stage.append(this.dots, ...this.levelOfDetail.elements, ...this.presence.elements, ...above);
    this.keyboard = new Keyboard(this);
    this.nudge = new Nudge(this);
  }

  #wire() {
    this.viewport.onChange = () => this.#viewChanged();
    this.viewport.onIdle = () => this.#viewIdle();
    this.sizes = new ResizeObserver(() => this.#resized());
    this.sizes.observe(this.stage);
    onFontsLoaded(() => this.#fontsLoaded());
  }

  #fontsLoaded() {
    this.scene.remeasure();
    this.router.clear();
    this.painter.refresh({ touched: [...this.painter.items.keys()], gone: [], affectedNodes: [] });
    this.#sceneChanged();
  }

  #resized() {
    if (!this.viewport.measure()) return;
    const isUntouched = ["x", "y", "k"].every((name) => this.fitted?.[name] === this.viewport[name]);
    if (this.fitPending && this.scene.nodes.size) restoreView(this);
    else if (isUntouched) this.fit();
    this.viewport.set({});
  }

  #viewChanged() {
    const { x, y, k } = this.viewport;
    this.#placeDots(x, y, k);
    this.toolbar.show(k);
    this.minimap.viewChanged();
    this.rename.viewChanged();
    this.presence.viewChanged();
    this.levelOfDetail.viewChanged();
  }

  #viewIdle() {
    saveView(this.scene.component, this.viewport);
    this.levelOfDetail.viewIdle();
    this.handles.refresh();
  }

  /** The dots are one layer that is only moved and scaled; painting them anew in each frame would cost a third of all frames. */
  #placeDots(x, y, k) {
    let scale = k;
    while (scale < 0.7) scale *= 2;
    while (scale >= 1.4) scale /= 2;
    const gap = DOT_GAP * scale;
    const within = (value) => (((value % gap) + gap) % gap) - gap;
    this.dots.style.transform = `translate(${within(x)}px, ${within(y)}px) scale(${scale})`;
  }

  #coloursChanged() {
    this.levelOfDetail.coloursChanged();
    this.frame?.schedule("colours", () => {
      this.minimap.draw();
      this.levelOfDetail.scheduleRedraw();
    });
  }

  #sceneChanged() {
    this.host.dataset.rev = String(this.scene.rev);
    this.empty.hidden = [...this.scene.nodes.values()].some((node) => node.of === "states");
    this.stage.setAttribute("aria-label", `State machine ${this.scene.component}`);
    this.levelOfDetail.sceneChanged();
    this.frame.schedule("minimap", () => this.minimap.draw());
    this.frame.schedule("scene", () => {
      this.cull();
      this.handles.refresh();
      this.rename.viewChanged();
      this.presence.draw();
    });
  }

  #testApi() {
    const place = ({ x, y, w, h }) => ({ x, y, w, h });
    return {
      positions: () => Object.fromEntries([...this.scene.nodes.values()].map((node) => [`${node.of}/${node.id}`, place(node)])),
      selection: () => this.selection.items(),
      view: () => ({ x: this.viewport.x, y: this.viewport.y, k: this.viewport.k, far: this.isOverview, resting: this.viewport.isIdle }),
      setView: (view) => this.viewport.set(view),
      screen: (of, id) => {
        const thing = this.scene.find(keyOf(of, id));
        const at = this.viewport.toScreen(this.scene.nodes.has(thing.key) ? thing : this.router.route(thing).at);
        const box = this.stage.getBoundingClientRect();
        return { x: at.x + box.left, y: at.y + box.top };
      },
      mounted: () => this.painter.items.size,
    };
  }
}
