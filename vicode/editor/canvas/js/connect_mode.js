// Connecting without holding a button: a click on the target ends it, or keys choose a target and Enter confirms.
import { nearestInDirection } from "./keyboard_navigation.js";
import { chooseTarget, confirmTarget } from "./strings.js";

const TYPING_MS = 1200;

export class ConnectMode {
  /**
   * @param gesture a drag of connect_drags.js
   * @param from the key of the node that it starts from
   * @param action the beginning of the message, such as "Connect to"
   */
  constructor(canvas, gesture, from, action) {
    this.canvas = canvas;
    this.gesture = gesture;
    this.from = from;
    this.action = action;
    this.aimed = null;
    this.typed = { text: "", time: 0 };
  }

  begin() {
    this.gesture.begin();
    this.#showMessage();
  }

  move(where) {
    this.aimed = null;
    this.gesture.move(where);
  }

  /** Connects to the node under the pointer. */
  end() {
    this.gesture.end();
  }

  /** Connects to the node chosen by keys, or to the start node if none is chosen. */
  finish() {
    const target = this.canvas.scene.nodes.get(this.aimed ?? this.from);
    this.gesture.cancel();
    if (target && this.gesture.accepts(target)) this.gesture.connectTo(target);
  }

  cancel() {
    this.gesture.cancel();
  }

  sceneChanged() {
    this.gesture.sceneChanged();
  }

  /** Tab: chooses the next possible target in the order of the design; wraps around. */
  aimNext(step) {
    const targets = this.#targets();
    const keys = [...this.canvas.scene.nodes.keys()];
    const index = keys.indexOf(this.aimed ?? this.from);
    const rotated = step > 0 ? [...keys.slice(index + 1), ...keys.slice(0, index + 1)] : [...keys.slice(0, index).reverse(), ...keys.slice(index).reverse()];
    this.#aim(rotated.map((key) => targets.find((node) => node.key === key)).find(Boolean));
  }

  /** Arrow keys: chooses the nearest possible target in a direction. */
  aimInDirection(direction) {
    const from = this.canvas.scene.nodes.get(this.aimed ?? this.from);
    if (from) this.#aim(nearestInDirection(this.#targets(), from, direction));
  }

  /** Letters: chooses the first possible target whose name starts with the typed text. */
  aimByName(letter) {
    const now = performance.now();
    const isContinued = now - this.typed.time < TYPING_MS;
    this.typed = { text: (isContinued ? this.typed.text : "") + letter.toLowerCase(), time: now };
    this.#aim(this.#targets().find(({ id }) => id.toLowerCase().startsWith(this.typed.text)));
    return true;
  }

  #targets() {
    return this.canvas.scene.shownNodes().filter((node) => this.gesture.accepts(node));
  }

  #aim(node) {
    if (!node) return;
    this.aimed = node.key;
    this.canvas.reveal(node.key);
    this.gesture.move({ world: { x: node.x, y: node.y } });
    this.canvas.painter.mark("drop", [node.key]);
    this.#showMessage();
  }

  #showMessage() {
    const target = this.canvas.scene.nodes.get(this.aimed);
    this.canvas.showMessage(target ? confirmTarget(this.action, target.id) : chooseTarget(this.action));
  }
}
