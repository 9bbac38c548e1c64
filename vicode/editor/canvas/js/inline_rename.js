// The name field: over a node or frame that it renames, or over the place of one that is created when it closes. Python validates the name.
import { ConnectionPreview, NEW_STATE } from "./connect_drags.js";
import { FramePreview, frameRect, titlePlace } from "./frames.js";
import { keyOf } from "./scene.js";
import { NAME } from "./strings.js";
import { html } from "./svg.js";

export class InlineRename {
  constructor(canvas) {
    this.canvas = canvas;
    this.key = null;
    this.draft = null;
    this.input = html("input", { class: "rename", type: "text", spellcheck: "false", hidden: true, "aria-label": NAME });
    this.input.addEventListener("keydown", (event) => this.#down(event));
    this.input.addEventListener("blur", () => this.keep());
    for (const name of ["pointerdown", "keyup", "wheel"]) this.input.addEventListener(name, (event) => event.stopPropagation());
  }

  start(key) {
    const node = this.canvas.scene.nameOf(key);
    if (!node) return;
    this.keep();
    this.canvas.reveal(key);
    this.key = key;
    this.#open(nameOf(node));
  }

  /**
   * Asks for the name of a new state at (x, y), to which a transition leads from the node `source`, if any. The field
   * is open before the next key press arrives: creating the state first would take a message to the server and back.
   */
  startNew({ x, y, source = null }) {
    this.keep();
    const { canvas } = this;
    const place = { x, y, ...NEW_STATE };
    this.draft = { place, source, preview: new ConnectionPreview(canvas, { line: Boolean(source), box: true }) };
    canvas.revealPlace(place);
    this.#open("");
  }

  /** Asks for the title of a new frame around states. */
  startFrame(nodes) {
    this.keep();
    const { canvas } = this;
    const area = frameRect(nodes);
    this.draft = { place: titlePlace(area), states: nodes.map(({ id }) => id), preview: new FramePreview(canvas, area) };
    canvas.revealPlace(this.draft.place);
    this.#open("");
  }

  /** The state was renamed: the field stays open, and its text will rename the state again, or a new one starts from it. */
  stateRenamed(old, name) {
    this.canvas.selection.stateRenamed(old, name);
    if (this.draft?.source === keyOf("states", old)) this.draft.source = keyOf("states", name);
    if (!this.key || this.key !== keyOf("states", old)) return;
    this.key = keyOf("states", name);
    this.isRenamePending = true;
    this.canvas.report("state-renamed", { old, new: name });
  }

  /** Keeps the field over its node; closes it if the node was removed. */
  viewChanged() {
    if (this.draft) this.#showDraft();
    if (!this.key) return;
    const node = this.canvas.scene.nameOf(this.key);
    if (!node && this.isRenamePending) return;
    this.isRenamePending = false;
    if (node) this.#placeOver(node);
    else this.#close({ keep: false });
  }

  #open(text) {
    this.input.value = text;
    this.input.hidden = false;
    this.viewChanged();
    this.input.focus({ preventScroll: true });
    this.input.select();
  }

  #showDraft() {
    const { place, source, preview } = this.draft;
    preview.show(this.canvas.scene.nodes.get(source), place, true);
    this.#placeOver(place);
  }

  #placeOver({ x, y, w, h }) {
    const { viewport } = this.canvas;
    const at = viewport.toScreen({ x: x - w / 2, y: y - h / 2 });
    const scale = Math.max(0.6, viewport.k);
    Object.assign(this.input.style, {
      left: `${at.x}px`,
      top: `${at.y + (h * viewport.k - 36 * scale) / 2}px`,
      width: `${Math.max(120, w * viewport.k)}px`,
      height: `${36 * scale}px`,
      fontSize: `${14 * scale}px`,
    });
  }

  /** Applies what is typed; the user has turned to something else. */
  keep() {
    this.#close({ keep: true, select: false });
  }

  #down(event) {
    // The page handles saving; the typed name is applied first, so that it is saved too.
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "s") return this.#leave(true);
    event.stopPropagation();
    if (!["Enter", "Escape", "Tab"].includes(event.key)) return;
    event.preventDefault();
    this.#leave(event.key !== "Escape");
  }

  #leave(keep) {
    this.#close({ keep, select: true });
    if (!this.canvas.guard.isOpen) this.canvas.stage.focus({ preventScroll: true });
  }

  /** `select`: selects a new state; not if the user has turned to something else. */
  #close({ keep, select }) {
    const { key, draft } = this;
    if (!key && !draft) return;
    const name = this.input.value.trim();
    this.key = this.draft = null;
    this.input.hidden = true;
    if (draft) this.#create(draft, keep ? name : "", { select, asksGuard: keep && select });
    else this.#rename(key, keep ? name : "");
  }

  /** Without a name Python chooses one. */
  #create({ place, source, states, preview }, name, { select, asksGuard }) {
    const { canvas } = this;
    const [from, { x, y }] = [canvas.scene.nodes.get(source), place];
    preview.close();
    if (states) return canvas.report("frame", { states, title: name });
    if (from) return this.#connect(from, place, name, { select, asksGuard });
    if (name) canvas.showCreated({ id: name, name, x, y }, select);
    canvas.report("create", { x, y, name, select });
  }

  /** Creates a transition to the state of this name, or to a new one. */
  #connect(from, place, name, { select, asksGuard }) {
    const { canvas } = this;
    const known = canvas.scene.nodes.get(keyOf("states", name));
    const { x, y } = place;
    const connection = known ? { source: from.id, target: known.id } : { source: from.id, target: null, x, y, name };
    if (name && !known) canvas.showCreated({ id: name, name, x, y }, select);
    if (asksGuard) canvas.guard.startNew(from, canvas.scene.nodes.get(keyOf("states", name)) ?? place, connection);
    else canvas.report("connect", { ...connection, guard: "", select });
  }

  #rename(key, name) {
    const node = this.canvas.scene.find(key);
    if (node && name && name !== nameOf(node)) this.canvas.report("rename", { item: { of: node.of, id: node.id }, name });
  }
}

const nameOf = (node) => (node.of === "components" ? node.data.id : node.data.name);
