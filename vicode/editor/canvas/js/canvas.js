// The canvas itself: puts the parts together, and is what Python's methods reach.
import { Clipboard } from "./clipboard.js";
import { Commands } from "./commands.js";
import { bounds, rectOf } from "./geometry.js";
import { Frame } from "./frame.js";
import { Gestures } from "./gestures.js";
import { Handles } from "./handles.js";
import { Keyboard } from "./keyboard.js";
import { Levels } from "./levels.js";
import { Menu } from "./menu.js";
import { arrive, remember } from "./memory.js";
import { Minimap } from "./minimap.js";
import { Nudging } from "./nudging.js";
import { Painter } from "./painter.js";
import { Peek } from "./peek.js";
import { People } from "./people.js";
import { Preview } from "./preview.js";
import { Rename } from "./rename.js";
import { Router } from "./routing.js";
import { keyOf, Scene } from "./scene.js";
import { Selection } from "./selection.js";
import { html } from "./svg.js";
import { awaitFonts, whenFontsCome } from "./text.js";
import { Theme } from "./theme.js";
import { Toolbar } from "./toolbar.js";
import { Viewport } from "./viewport.js";

const DOT_GAP = 20;
const DIM_MS = 120;
const TELL_MS = 3000;

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
    this.told = 0;
    this.fitPending = true;
    this.frame = new Frame();
    this.scene = new Scene();
    this.router = new Router(this.scene);
    this.painter = new Painter(this.scene, this.router);
    this.#build();
    this.#wire();
    host.vicode = this.#testing();
  }

  load(view) {
    const same = view.component === this.scene.component;
    const kept = same ? [...this.selection.keys] : [];
    this.gestures.cancel();
    this.painter.clear();
    this.router.clear();
    this.scene.load(view);
    this.nudging.forget();
    this.theme.set(view.theme);
    this.fitPending = this.fitPending || !same;
    this.selection.keys = new Set();
    this.selection.set(kept, { quiet: true });
    this.painter.mark("stop", this.stops ?? []);
    if (this.fitPending && this.viewport.measure()) arrive(this);
    this.#sceneChanged();
    this.host.dataset.ready = "true";
  }

  apply(changes) {
    const change = this.scene.apply(changes);
    this.nudging.hear();
    this.painter.refresh(change);
    if (this.selection.prune()) this.painter.mark("selected", this.selection.keys);
    this.gestures.sceneChanged();
    this.#sceneChanged();
  }

  /** What Python wishes to be selected; it is too late when the hand selected anew before Python `heard` of it. */
  select(items, heard = this.told) {
    if (heard !== this.told) return;
    this.selection.set(items.map(({ of, id }) => keyOf(of, id)), { quiet: true });
  }

  centre(of, id) {
    const thing = this.scene.find(keyOf(of, id));
    if (!thing) return;
    const { x, y } = this.scene.nodes.has(thing.key) ? thing : this.scene.isDrawable(thing) ? this.router.route(thing).at : this.viewport.middle();
    this.viewport.centreOn(x, y, Math.max(this.viewport.k, 0.6));
  }

  /** Brings a thing into view as the page opens; the view of a page that was left and is come back to stays. */
  arriveAt(of, id) {
    return this.recalled ? this.reveal(keyOf(of, id)) : this.centre(of, id);
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
    const extent = bounds(keys.map((key) => this.scene.nodes.get(key)).filter(Boolean).map(rectOf));
    if (extent && this.viewport.measure()) this.viewport.fit(extent);
  }

  /** Highlights the states a running component is in; an older picture never replaces a newer one. */
  setActive(ids, seq, taken = []) {
    if (seq <= this.activeSeq) return;
    this.activeSeq = seq;
    this.frame.ask("active", () => {
      this.painter.mark("active", ids.map((id) => keyOf("states", id)));
      this.painter.mark("taken", taken.map((id) => keyOf("transitions", id)));
      if (this.far) this.cull();
      this.emit("ack", { seq: this.activeSeq });
    });
  }

  /** Shows signs at the things where a run is to rest. */
  setStops(items) {
    this.stops = items.map(({ of, id }) => keyOf(of, id));
    this.painter.mark("stop", this.stops);
  }

  showLinks(flag) {
    if (this.scene.linksShown === flag) return;
    this.scene.linksShown = flag;
    this.router.clear();
    this.painter.refresh({ touched: [...this.scene.edges.keys()], gone: [], near: [...this.scene.nodes.keys()] });
    this.#sceneChanged();
  }

  renameInPlace(id) {
    this.rename.start(keyOf("states", id));
  }

  dispose() {
    this.frame.stop();
    this.keyboard.dispose();
    this.clipboard.dispose();
    this.people.dispose();
    this.sizes.disconnect();
    this.theme.dispose();
  }

  /** Shows other places, given as `{of, id, x, y}`, without taking them; none ends it. `stay`: the view stays too. */
  showPlaces(items, stay) {
    if (items.length) this.preview.show(items.map(({ of, id, x, y }) => ({ key: keyOf(of, id), x, y })));
    else this.preview.clear({ stay });
  }

  /** Sends one gesture to Python. */
  report(kind, payload) {
    if (kind !== "move") this.nudging.forget();
    this.emit("gesture", { kind, ...payload, rev: this.scene.rev });
  }

  /** Moves boxes by a command; `how` says by which, for the name of the edit. */
  moveTo(places, how) {
    const keys = [...places.keys()];
    const rects = keys.map((key) => rectOf(this.scene.nodes.get(key)));
    for (const [key, { x, y }] of places) this.scene.move(key, x, y);
    this.painter.follow(keys);
    this.reportMove(keys, rects, how);
    this.afterGesture();
  }

  /** Boxes were moved by hand: everything that depends on their place follows, and Python is told. */
  reportMove(keys, oldRects, how = "drag") {
    const nodes = keys.map((key) => this.scene.nodes.get(key));
    this.scene.reindex(keys);
    this.painter.tidy([...oldRects, ...nodes.map(rectOf)]);
    this.painter.covered = null;
    this.report("move", { items: nodes.map(({ of, id, x, y }) => ({ of, id, x, y })), how });
    this.#sceneChanged();
  }

  /** Boxes stand elsewhere for some other reason than a hand. */
  placesChanged(keys) {
    this.scene.reindex(keys);
    this.router.clear();
    this.painter.placeAnew();
    this.painter.covered = null;
    this.#sceneChanged();
  }

  afterGesture() {
    this.painter.tidy();
    this.handles.refresh();
    this.levels.cullSoon();
  }

  hoverChanged() {
    this.peek.want(this.selection.hovered);
    this.handles.refresh();
    if (this.far) this.levels.cullSoon();
  }

  /** The selection changed, by Python's wish (`quiet`) or by hand. */
  selectionChanged(quiet) {
    this.handles.refresh();
    if (!quiet) this.report("select", { items: this.selection.items(), told: ++this.told });
    this.levels.selectionChanged();
  }

  /** Brings the mounted part up to what is seen. */
  cull() {
    this.levels.cull();
  }

  /** Whether all is seen as a bitmap. */
  get far() {
    return this.levels.far;
  }

  /** Brings a thing into sight, and near enough to be read. */
  reveal(key) {
    const thing = this.scene.find(key);
    if (!thing) return;
    if (this.far) this.centre(thing.of, thing.id);
    else if (this.scene.nodes.has(key)) this.viewport.reveal(rectOf(thing));
    else if (this.scene.isDrawable(thing)) this.viewport.reveal({ ...this.router.route(thing).at, w: 0, h: 0 });
    this.frame.flush();
    this.cull();
  }

  /** What is lit changed: the rest steps back once the hand rests. */
  dimSoon() {
    this.frame.afterRest("dim", DIM_MS, () => (this.gestures.isDragging() ? this.dimSoon() : this.painter.dim()));
  }

  say(text) {
    this.message.textContent = text;
  }

  /** Words that go by themselves. */
  tell(text) {
    this.say(text);
    this.frame.afterRest("tell", TELL_MS, () => this.message.textContent === text && this.say(""));
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
    this.levels = new Levels(this, html("div", { class: "plane", ...heard }, this.painter.sheets), colours);
    this.theme = new Theme(this.stage, () => this.#coloursChanged());
    this.toolbar = new Toolbar(this);
    this.selection = new Selection(this);
    this.gestures = new Gestures(this);
    this.handles = new Handles(this);
    this.clipboard = new Clipboard(this);
    this.commands = new Commands(this, this.table);
    this.menu = new Menu(this);
    this.rename = new Rename(this);
    this.preview = new Preview(this);
    this.peek = new Peek(this);
    this.people = new People(this);
    this.dots = html("div", { class: "dots" });
    // Always there, as what only comes with its words is not read aloud by all screen readers.
    this.message = html("div", { class: "message", role: "status" });
    this.empty = html("div", { class: "empty", hidden: true, text: "No states yet.\nDouble click, or press S, to add the first." });
    const corner = html("div", { class: "corner" }, [this.minimap.element, this.toolbar.element]);
    const above = [this.empty, this.message, this.rename.input, corner, this.peek.element, this.menu.element];
    this.stage.append(this.dots, ...this.levels.elements, ...this.people.elements, ...above);
    this.keyboard = new Keyboard(this);
    this.nudging = new Nudging(this);
  }

  #wire() {
    this.viewport.onChange = () => this.#viewChanged();
    this.viewport.onRest = () => this.#viewRests();
    this.sizes = new ResizeObserver(() => this.#resized());
    this.sizes.observe(this.stage);
    whenFontsCome(() => this.#fontsCame());
  }

  #fontsCame() {
    this.scene.remeasure();
    this.router.clear();
    this.painter.refresh({ touched: [...this.painter.items.keys()], gone: [], near: [] });
    this.#sceneChanged();
  }

  #resized() {
    if (!this.viewport.measure()) return;
    const isUntouched = ["x", "y", "k"].every((name) => this.fitted?.[name] === this.viewport[name]);
    if (this.fitPending && this.scene.nodes.size) arrive(this);
    else if (isUntouched) this.fit();
    this.viewport.set({});
  }

  #viewChanged() {
    const { x, y, k } = this.viewport;
    this.#placeDots(x, y, k);
    this.toolbar.show(k);
    this.minimap.follow();
    this.rename.follow();
    this.people.follow();
    this.levels.follow();
  }

  #viewRests() {
    remember(this.scene.component, this.viewport);
    this.levels.rest();
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
    this.levels.coloursChanged();
    this.frame?.ask("colours", () => {
      this.minimap.draw();
      this.levels.redrawSoon();
    });
  }

  #sceneChanged() {
    this.host.dataset.rev = String(this.scene.rev);
    this.empty.hidden = [...this.scene.nodes.values()].some((node) => node.of === "states");
    this.stage.setAttribute("aria-label", `State machine ${this.scene.component}`);
    this.levels.sceneChanged();
    this.frame.ask("minimap", () => this.minimap.draw());
    this.frame.ask("scene", () => {
      this.cull();
      this.handles.refresh();
      this.rename.follow();
      this.people.draw();
    });
  }

  #testing() {
    const place = ({ x, y, w, h }) => ({ x, y, w, h });
    return {
      positions: () => Object.fromEntries([...this.scene.nodes.values()].map((node) => [`${node.of}/${node.id}`, place(node)])),
      selection: () => this.selection.items(),
      view: () => ({ x: this.viewport.x, y: this.viewport.y, k: this.viewport.k, far: this.far, resting: this.viewport.resting }),
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
