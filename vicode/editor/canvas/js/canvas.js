// The canvas: assembles its parts and implements the methods that Python calls.
import { Clipboard } from "./clipboard.js";
import { Commands } from "./commands.js";
import { bounds, nodeRect } from "./geometry.js";
import { FrameScheduler } from "./frame_scheduler.js";
import { PointerGestures } from "./gestures.js";
import { GuardField } from "./guard_field.js";
import { Handles } from "./handles.js";
import { Keyboard } from "./keyboard.js";
import { LEGIBLE_ZOOM, LevelOfDetail } from "./level_of_detail.js";
import { Menu } from "./menu.js";
import { restoreView, saveView } from "./view_state.js";
import { Minimap } from "./minimap.js";
import { Neighborhood } from "./neighborhood.js";
import { Nudge } from "./nudge.js";
import { OffScreenEnds } from "./off_screen_ends.js";
import { announce, announceOpening } from "./page_events.js";
import { Painter } from "./painter.js";
import { Tooltip } from "./tooltip.js";
import { PresenceLayer } from "./presence.js";
import { LayoutPreview } from "./layout_preview.js";
import { Insets } from "./insets.js";
import { InlineRename } from "./inline_rename.js";
import { Router } from "./routing.js";
import { keyOf, Scene } from "./scene.js";
import { Selection } from "./selection.js";
import { DIAGRAM, EMPTY, STAGE_ROLE, namesOnly, stageName } from "./strings.js";
import { html } from "./svg.js";
import { awaitFonts, onFontsLoaded } from "./text_metrics.js";
import { testApi } from "./test_api.js";
import { Theme } from "./theme.js";
import { Toolbar } from "./toolbar.js";
import { Viewport } from "./viewport.js";

const DOT_GAP = 20;
const TOAST_MS = 3000;

const sheet = new CSSStyleSheet();
const [styles] = await Promise.all([fetch(new URL("./canvas.css", import.meta.url)), awaitFonts()]);
sheet.replaceSync(await styles.text());

/** Mounts a canvas in the shadow root of `host`; it reports events by `emit(event, payload)`. `table`: the commands. */
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
    host.vicode = testApi(this);
  }

  load(view) {
    const isSame = view.component === this.scene.component;
    const kept = isSame ? [...this.selection.keys] : [];
    this.gestures.cancel();
    this.painter.clear();
    this.router.clear();
    this.neighborhood.leave();
    this.scene.load(view);
    this.nudge.reset();
    this.theme.set(view.theme);
    this.fitPending = this.fitPending || !isSame;
    this.selection.keys = new Set();
    this.selection.set(kept, { quiet: true });
    this.painter.mark("breakpoint", this.breakpoints ?? []);
    this.painter.showHeat();
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

  /** Selection by Python; ignored if the user has changed the selection since the one that Python acknowledges by `seq`. */
  select(items, seq = this.clientSeq) {
    if (seq === this.clientSeq) this.selection.set(items.map(({ of, id }) => this.scene.keyOf(of, id)), { quiet: true });
  }

  center(of, id) {
    const element = this.scene.find(this.scene.keyOf(of, id));
    if (!element) return;
    this.neighborhood.leaveFor(element);
    const { x, y } = this.scene.nameOf(element.key) ?? (this.scene.isDrawable(element) ? this.router.route(element).at : this.viewport.middle());
    this.viewport.centerOn(x, y, Math.max(this.viewport.k, 0.6));
  }

  /** Centers an element as the page opens; a view restored from the browser's history only reveals it. */
  scrollToInitial(of, id) {
    return this.restoredView ? this.reveal(this.scene.keyOf(of, id)) : this.center(of, id);
  }

  fit() {
    if (!this.viewport.measure()) return;
    const extent = bounds([this.scene.extent(), this.router.extent()].filter(Boolean));
    this.fitPending = false;
    if (extent) this.viewport.fit(extent);
    else this.viewport.centerOn(0, 0, 1);
    const { x, y, k } = this.viewport;
    this.fitted = { x, y, k };
    if (k < LEGIBLE_ZOOM) this.showToast(namesOnly(Math.round(k * 100)));
  }

  /** Fits the selection, including the end nodes of selected edges. */
  zoomToSelection() {
    const keys = [...this.selection.keys].flatMap((key) => {
      const edge = this.scene.edges.get(key);
      return edge ? [edge.source, edge.target] : [key];
    });
    const extent = bounds(keys.map((key) => this.scene.boxOf(key)).filter(Boolean));
    if (extent && this.viewport.measure()) this.viewport.fit(extent);
  }

  /** Highlights the active states of a running component; calls with an older sequence number are ignored. */
  highlightActive(ids, seq, taken = [], inner = {}) {
    if (seq <= this.activeSeq) return;
    this.activeSeq = seq;
    this.frame.schedule("active", () => {
      this.painter.mark("active", ids.map((id) => keyOf("states", id)));
      this.selection.updateHighlight();
      this.painter.mark("taken", taken.map((id) => this.scene.keyOf("transitions", id)));
      this.insets.highlight(inner);
      if (this.isOverview) this.cull();
      this.emit("ack", { seq: this.activeSeq });
    });
  }

  /** Shows breakpoint signs at exactly these elements. */
  setBreakpoints(items) {
    this.breakpoints = items.map(({ of, id }) => this.scene.keyOf(of, id));
    this.painter.mark("breakpoint", this.breakpoints);
  }

  showLinks(flag) {
    if (this.scene.linksShown === flag) return;
    this.scene.linksShown = flag;
    this.visibilityChanged();
  }

  /** Redraws everything after elements were shown or hidden. */
  visibilityChanged() {
    this.router.clear();
    this.painter.refresh({ touched: [...this.scene.edges.keys()], gone: [], affectedNodes: [...this.scene.nodes.keys()] });
    this.painter.mountedRect = null;
    this.selection.updateHighlight();
    this.#sceneChanged();
  }

  focus() {
    this.stage.focus({ preventScroll: true });
  }

  dispose() {
    this.frame.stop();
    this.keyboard.dispose();
    this.clipboard.dispose();
    this.presence.dispose();
    this.sizes.disconnect();
    this.theme.dispose();
  }

  /** Previews node positions `{of, id, x, y}`; an empty list ends the preview. `stay`: keep the view at its end. */
  showPreview(items, stay) {
    if (items.length) this.preview.show(items.map(({ of, id, x, y }) => ({ key: keyOf(of, id), x, y })));
    else this.preview.clear({ stay });
  }

  /** Sends one gesture to Python; `rev` is the revision in which it was made, `seq` counts the selections before it. */
  report(kind, payload, rev = this.scene.rev) {
    if (kind !== "move") this.nudge.reset();
    this.emit("gesture", { kind, ...payload, ...announceOpening(this.host, kind, payload), rev, seq: this.clientSeq });
  }

  /** Moves nodes to `positions` (by key); `how` is the command, for the name of the edit. */
  moveNodes(positions, how) {
    const keys = [...positions.keys()];
    const rects = keys.map((key) => nodeRect(this.scene.nodes.get(key)));
    for (const [key, { x, y }] of positions) this.scene.move(key, x, y);
    this.painter.updateNodes(keys);
    this.reportMove(keys, rects, how);
    this.afterGesture();
  }

  /** Updates everything that depends on the positions of moved nodes, and reports the move. */
  reportMove(keys, oldRects, how = "drag") {
    const nodes = keys.map((key) => this.scene.nodes.get(key));
    this.scene.reindex(keys);
    this.painter.refineRoutes([...oldRects, ...nodes.map(nodeRect)]);
    this.painter.mountedRect = null;
    this.report("move", { items: nodes.map(({ of, id, x, y }) => ({ of, id, x, y })), how });
    this.#sceneChanged();
  }

  /** Updates the canvas after nodes were moved programmatically. */
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
    this.offScreenEnds.refresh();
    this.levelOfDetail.scheduleCull();
  }

  hoverChanged() {
    this.tooltip.request(this.selection.hovered);
    this.handles.refresh();
    if (this.isOverview) this.levelOfDetail.scheduleCull();
  }

  /** Called after each change of the selection; `quiet` if Python set it. */
  selectionChanged(quiet) {
    this.handles.refresh();
    this.offScreenEnds.refresh();
    const [items, seq] = [this.selection.items(), quiet ? this.clientSeq : ++this.clientSeq];
    if (!quiet) announce(this.host, "vicode-select", { items, seq });
    if (!quiet) this.report("select", { items });
    this.levelOfDetail.selectionChanged();
  }

  /** Mounts what is visible. */
  cull() {
    this.levelOfDetail.cull();
  }

  /** Whether the scene is shown as a bitmap. */
  get isOverview() {
    return this.levelOfDetail.far;
  }

  /** Scrolls an element into view, at a readable zoom. */
  reveal(key) {
    const element = this.scene.find(key);
    if (!element) return;
    this.neighborhood.leaveFor(element);
    if (this.isOverview) this.center(element.of, element.id);
    else if (this.scene.nameOf(key)) this.viewport.reveal(nodeRect(this.scene.nameOf(key)));
    else if (this.scene.isDrawable(element)) this.viewport.reveal({ ...this.router.route(element).at, w: 0, h: 0 });
    this.frame.flush();
    this.cull();
  }

  /** Scrolls a rectangle with the center (x, y) into view, at a readable zoom. */
  revealPlace(place) {
    if (this.isOverview) this.viewport.centerOn(place.x, place.y, Math.max(this.viewport.k, 0.6));
    else this.viewport.reveal(nodeRect(place));
  }

  /** Draws a state whose creation is reported next; Python sends its data. Earlier answers do not change its selection. */
  showCreated(state, select) {
    if (this.scene.nodes.has(keyOf("states", state.id))) return;
    this.apply({ rev: this.scene.rev, upsert: { states: [state] } });
    this.clientSeq += Number(select);
    if (select) this.selection.set([keyOf("states", state.id)], { quiet: true });
  }

  showMessage(text) {
    this.message.textContent = text;
  }

  /** Shows a message that disappears by itself. */
  showToast(text) {
    this.showMessage(text);
    this.frame.debounce("toast", TOAST_MS, () => this.message.textContent === text && this.showMessage(""));
  }

  #build() {
    this.root = this.host.attachShadow({ mode: "open" });
    this.root.adoptedStyleSheets = [sheet];
    this.stage = html("div", { class: "stage", tabindex: "0", role: "application", "aria-roledescription": STAGE_ROLE });
    this.root.append(this.stage);
    const colors = (name) => this.theme.color(name);
    this.viewport = new Viewport(this.stage, this.frame);
    this.minimap = new Minimap(this.scene, this.viewport, colors);
    // Screen readers read nodes first, although they are painted last.
    const readingOrder = { role: "group", "aria-label": DIAGRAM, "aria-owns": "nodes edges links frames" };
    this.levelOfDetail = new LevelOfDetail(this, html("div", { class: "plane", ...readingOrder }, this.painter.svgRoots), colors);
    this.theme = new Theme(this.stage, () => this.#colorsChanged());
    this.toolbar = new Toolbar(this);
    this.selection = new Selection(this);
    this.gestures = new PointerGestures(this);
    this.handles = new Handles(this);
    this.clipboard = new Clipboard(this);
    this.commands = new Commands(this, this.table);
    this.menu = new Menu(this);
    this.rename = new InlineRename(this);
    this.guard = new GuardField(this);
    this.preview = new LayoutPreview(this);
    this.insets = new Insets(this);
    this.offScreenEnds = new OffScreenEnds(this);
    this.neighborhood = new Neighborhood(this);
    this.tooltip = new Tooltip(this);
    this.presence = new PresenceLayer(this);
    this.dots = html("div", { class: "dots" });
    // Always mounted: some screen readers do not announce a status element that is added together with its text.
    this.message = html("div", { class: "message", role: "status" });
    this.empty = html("div", { class: "empty", hidden: true, text: EMPTY });
    this.corner = html("div", { class: "corner" }, [this.minimap.element, this.toolbar.element]);
    const above = [this.empty, this.message, this.rename.input, this.guard.input, this.corner, this.offScreenEnds.element, this.neighborhood.element, this.tooltip.element, this.menu.element];
    this.stage.append(this.dots, ...this.levelOfDetail.elements, ...this.presence.elements, this.insets.element, ...above);
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
    for (const field of [this.rename, this.guard]) field.viewChanged();
    this.insets.place();
    this.presence.viewChanged();
    this.offScreenEnds.refresh();
    this.levelOfDetail.viewChanged();
  }

  #viewIdle() {
    saveView(this.scene.component, this.viewport);
    this.levelOfDetail.viewIdle();
    this.handles.refresh();
    this.offScreenEnds.refresh();
  }

  /** The dots are one layer that is only moved and scaled. Repainting them in each frame drops a third of the frames. */
  #placeDots(x, y, k) {
    let scale = k;
    while (scale < 0.7) scale *= 2;
    while (scale >= 1.4) scale /= 2;
    const gap = DOT_GAP * scale;
    const wrap = (value) => (((value % gap) + gap) % gap) - gap;
    this.dots.style.transform = `translate(${wrap(x)}px, ${wrap(y)}px) scale(${scale})`;
  }

  #colorsChanged() {
    this.levelOfDetail.colorsChanged();
    this.frame?.schedule("colors", () => {
      this.minimap.draw();
      this.levelOfDetail.scheduleRedraw();
    });
  }

  #sceneChanged() {
    this.host.dataset.rev = String(this.scene.rev);
    this.empty.hidden = [...this.scene.nodes.values()].some((node) => node.of === "states");
    this.stage.setAttribute("aria-label", stageName(this.scene.component));
    this.levelOfDetail.sceneChanged();
    this.frame.schedule("minimap", () => this.minimap.draw());
    this.frame.schedule("scene", () => {
      this.cull();
      this.handles.refresh();
      this.insets.place();
      for (const field of [this.rename, this.guard]) field.viewChanged();
      this.presence.draw();
    });
  }
}
