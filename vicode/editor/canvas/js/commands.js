// The handlers of the canvas commands. Names, labels and shortcuts come from Python's table.
import { align, distribute, findFreePosition } from "./alignment.js";
import { SNAP } from "./geometry.js";
import { nudgeLabel } from "./label_drag.js";
import { nearestInDirection, tabOrder } from "./keyboard_navigation.js";

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const PAN = 60;
// The groups of commands that change the design, or begin to.
const EDITS = ["Create", "Modify"];

export class Commands {
  constructor(canvas, table) {
    this.canvas = canvas;
    this.handlers = { ...createHandlers(canvas), ...modifyHandlers(canvas), ...editHandlers(canvas), ...arrangeHandlers(canvas), ...viewHandlers(canvas), ...navigationHandlers(canvas) };
    this.table = table.filter(({ name }) => name in this.handlers);
  }

  /** Runs the first available command with this shortcut; returns false if there is none. */
  runShortcut(chord) {
    const command = this.find(chord);
    return command ? this.run(command.name, chord) : false;
  }

  /** Returns the first available command with this shortcut. */
  find(chord) {
    return this.table.find(({ name, keys }) => keys.includes(chord) && this.can(name));
  }

  /** Whether a command changes the design by a single letter or sign. */
  isEdit(name) {
    const command = this.table.find((each) => each.name === name);
    return Boolean(command) && EDITS.includes(command.group) && command.keys.some((key) => key.length === 1);
  }

  run(name, chord = "") {
    if (!(name in this.handlers) || !this.can(name)) return false;
    return this.handlers[name].run(chord) !== false;
  }

  can(name) {
    return this.handlers[name].can?.() ?? true;
  }

  /** Sets whether a running robot can be sent to another state. */
  setControlsRobot(flag) {
    this.controlsRobot = flag;
  }

  /** Returns the commands of the context menu for the selection. */
  menuEntries() {
    const { selection, scene } = this.canvas;
    const single = selection.single();
    const kind = single ? scene.find(single).of : selection.keys.size ? "several" : "nothing";
    return this.table.filter(({ name, menus }) => menus.includes(kind) && this.can(name));
  }
}

function createHandlers(canvas) {
  const { selection, scene, gestures } = canvas;
  const node = () => scene.nodes.get(selection.single());
  const addNote = () => {
    const { x, y } = gestures.freePosition();
    canvas.revealPlace({ x, y, w: 120, h: 60 });
    canvas.report("note", { x, y });
  };
  const states = () => selection.nodes().map((key) => scene.nodes.get(key)).filter(({ of }) => of === "states");
  const hasTransitions = () => ["states", "common"].includes(node()?.of);
  return {
    "new-state": { run: () => canvas.rename.startNew(gestures.freePosition()) },
    use: { run: () => canvas.report("use", { address: null, ...gestures.freePosition() }) },
    "new-note": { run: addNote },
    frame: { can: () => states().length > 0, run: () => canvas.rename.startFrame(states()) },
    "frame-states": { can: () => scene.nodes.size > 0, run: () => gestures.drawFrame() },
    "new-target": { can: hasTransitions, run: () => canvas.rename.startNew({ source: node().key, ...freePositionNextTo(scene, node()) }) },
    connect: { can: () => Boolean(node()) && node().of !== "notes", run: () => gestures.connectFrom(selection.single()) },
    "finish-connection": { can: () => Boolean(gestures.connectMode), run: () => gestures.finishConnect() },
  };
}

function modifyHandlers(canvas) {
  const { selection, scene, gestures } = canvas;
  const single = () => scene.find(selection.single());
  const is = (...kinds) => () => kinds.includes(single()?.of);
  const open = () => canvas.report("open", { item: { of: single().of, id: single().id } });
  const reorder = (by) => canvas.report("reorder", { id: single().id, by });
  const mark = (name) => canvas.report("mark", { mark: name, id: single().id });
  return {
    "open-guard": { can: is("transitions"), run: () => canvas.guard.start(selection.single()) || open() },
    "open-design": { can: is("components"), run: open },
    "open-note": { can: is("notes"), run: open },
    "open-common": { can: is("common"), run: open },
    rename: { can: is("states", "components", "frames"), run: () => canvas.rename.start(selection.single()) },
    initial: { can: () => is("states")() && !single().data.initial, run: () => mark("initial") },
    final: { can: is("states"), run: () => mark("final") },
    disable: { can: () => selection.keys.size > 0, run: () => canvas.report("disable", { items: selection.items() }) },
    extract: { can: () => selection.items().some(({ of }) => of === "states"), run: () => canvas.report("command", { name: "extract" }) },
    inline: { can: () => is("states")() && single().data.requires > 0, run: () => canvas.report("command", { name: "inline" }) },
    "reconnect-target": { can: is("transitions"), run: () => gestures.reconnect(selection.single(), "target") },
    "reconnect-source": { can: is("transitions"), run: () => gestures.reconnect(selection.single(), "source") },
    "move-up": { can: is("transitions"), run: () => reorder(-1) },
    "move-down": { can: is("transitions"), run: () => reorder(1) },
    "reset-label": { can: () => Boolean(single()?.data.label_at), run: () => canvas.report("label", { id: single().id, at: null }) },
  };
}

function editHandlers(canvas) {
  const { selection, scene } = canvas;
  const some = () => selection.keys.size > 0;
  return {
    undo: { run: () => canvas.report("command", { name: "undo" }) },
    redo: { run: () => canvas.report("command", { name: "redo" }) },
    cut: { can: some, run: () => canvas.clipboard.copy({ cut: true }) },
    copy: { can: some, run: () => canvas.clipboard.copy() },
    // With a shortcut the browser's paste event carries the text; reading the clipboard would require a permission.
    paste: { run: (chord) => (chord ? false : canvas.clipboard.paste()) },
    duplicate: { can: some, run: () => canvas.report("duplicate", { items: selection.itemsWithContent() }) },
    delete: { can: some, run: () => canvas.report("delete", { items: selection.items() }) },
    "select-all": { run: () => selection.set([...scene.shownNodes(), ...scene.shownFrames()].map(({ key }) => key).concat(scene.drawableEdges())) },
  };
}

function arrangeHandlers(canvas) {
  const { selection, scene } = canvas;
  const boxes = () => selection.nodes().map((key) => scene.nodes.get(key));
  const arranging = (minimum, work, how) => ({
    can: () => selection.nodes().length >= minimum,
    run: () => canvas.moveNodes(work(boxes(), how), how),
  });
  return {
    ...Object.fromEntries(["left", "center", "right", "top", "middle", "bottom"].map((side) => [`align-${side}`, arranging(2, align, `align-${side}`)])),
    "distribute-across": arranging(3, distribute, "distribute-across"),
    "distribute-down": arranging(3, distribute, "distribute-down"),
    nudge: { run: (chord) => nudge(canvas, selection.movable().map((key) => scene.nodes.get(key)), directionOf(chord), chord.startsWith("Shift+") ? 1 : SNAP) },
    "lay-out": { run: () => canvas.report("command", { name: "lay-out" }) },
  };
}

function viewHandlers(canvas) {
  const { viewport, selection, scene } = canvas;
  const hasInside = (node) => Boolean(node && (node.of === "states" ? node.data.requires || node.data.modulates : node.data.design));
  const center = () => viewport.middle();
  const canFocus = () => scene.nodes.has(selection.single()) && scene.nodes.get(selection.single()).of !== "notes";
  return {
    fit: { run: () => canvas.fit() },
    "zoom-selection": { can: () => selection.keys.size > 0, run: () => canvas.zoomToSelection() },
    "actual-size": { run: () => viewport.centerOn(center().x, center().y, 1) },
    "zoom-in": { run: () => viewport.zoomBy(1.25) },
    "zoom-out": { run: () => viewport.zoomBy(0.8) },
    inside: { can: () => hasInside(scene.nodes.get(selection.single())), run: () => canvas.insets.toggle(selection.single()) },
    "focus-1": { can: canFocus, run: () => canvas.neighborhood.toggle(selection.single(), 1) },
    "focus-2": { can: canFocus, run: () => canvas.neighborhood.toggle(selection.single(), 2) },
    "show-all": { can: () => canvas.neighborhood.isOn, run: () => canvas.neighborhood.leave() },
    links: { run: () => canvas.report("command", { name: "links" }) },
    help: { run: () => canvas.report("command", { name: "help" }) },
    breakpoint: { can: () => selection.keys.size > 0, run: () => canvas.report("command", { name: "breakpoint" }) },
    "simulate-here": { can: () => selection.keys.size === 1, run: () => canvas.report("command", { name: "simulate-here" }) },
    "robot-enter": { can: () => canvas.commands.controlsRobot && selection.keys.size === 1, run: () => canvas.report("command", { name: "robot-enter" }) },
    menu: { run: () => canvas.menu.openAtSelection() },
  };
}

function navigationHandlers(canvas) {
  const { gestures, selection } = canvas;
  const cancel = () => {
    if (!gestures.cancel() && !canvas.neighborhood.leave()) selection.set([]);
  };
  return {
    next: { run: () => selectInTabOrder(canvas, 1) },
    previous: { run: () => selectInTabOrder(canvas, -1) },
    "select-nearest": { run: (chord) => selectNearest(canvas, directionOf(chord), false) },
    "add-nearest": { run: (chord) => selectNearest(canvas, directionOf(chord), true) },
    cancel: { run: cancel },
  };
}

const directionOf = (chord) => ARROWS[chord.split("+").at(-1)];

// Leaves room for the label of a short guard between the two states.
const freePositionNextTo = (scene, node) => findFreePosition(scene, node.x + node.w / 2 + 180, node.y);

function nudge(canvas, nodes, [dx, dy], step) {
  const { gestures, scene, selection, viewport } = canvas;
  if (gestures.connectMode) return gestures.connectMode.aimInDirection([dx, dy]);
  const edge = scene.edges.get(selection.single());
  if (edge?.of === "transitions" && scene.isDrawable(edge)) return nudgeLabel(canvas, edge, dx * step, dy * step);
  if (!nodes.length) return viewport.panBy(-dx * PAN, -dy * PAN);
  canvas.moveNodes(canvas.nudge.step(nodes, dx * step, dy * step), "nudge");
}

/** Tab selects the next element in the order of the design; after the last one it leaves the canvas. */
function selectInTabOrder(canvas, step) {
  const { gestures, scene, selection, painter } = canvas;
  if (gestures.connectMode) return gestures.connectMode.aimNext(step);
  const keys = tabOrder(scene);
  const index = keys.indexOf(selection.single());
  const next = index < 0 && step < 0 ? undefined : keys[index + step];
  if (!next) return false;
  selection.set([next]);
  canvas.reveal(next);
  painter.focus(next);
}

/** Selects the nearest node in a direction from the last selected node, or from the middle of the view. */
function selectNearest(canvas, direction, keep) {
  const { scene, selection, painter, viewport } = canvas;
  const from = scene.nodes.get(selection.nodes().at(-1)) ?? viewport.middle();
  const next = nearestInDirection(scene.shownNodes(), from, direction);
  if (!next) return;
  const kept = keep ? [...selection.keys].filter((key) => key !== next.key) : [];
  selection.set([...kept, next.key]);
  canvas.reveal(next.key);
  painter.focus(next.key);
}
