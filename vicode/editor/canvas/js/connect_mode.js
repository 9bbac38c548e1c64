// A connection without holding a button: the next click ends it, or keys aim at a box and Enter ends it.
import { nearestInDirection } from "./keyboard_navigation.js";

const TYPING_MS = 1200;

export class ConnectMode {
  /** Args: the canvas; a gesture of connecting.js; the node it starts from; what it is called, for the words shown. */
  constructor(canvas, gesture, from, what) {
    this.canvas = canvas;
    this.gesture = gesture;
    this.from = from;
    this.what = what;
    this.aimed = null;
    this.typed = { text: "", time: 0 };
  }

  begin() {
    this.gesture.begin();
    this.#say();
  }

  move(where) {
    this.aimed = null;
    this.gesture.move(where);
  }

  /** Ends where the pointer was pressed. */
  end() {
    this.gesture.end();
  }

  /** Ends at the box the keys aim at, at the start itself when they aim at none. */
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

  /** Tab: on to the next box that fits, in the order of the design. */
  aimNext(by) {
    const fitting = this.#fitting();
    const keys = [...this.canvas.scene.nodes.keys()];
    const at = keys.indexOf(this.aimed ?? this.from);
    const turned = by > 0 ? [...keys.slice(at + 1), ...keys.slice(0, at + 1)] : [...keys.slice(0, at).reverse(), ...keys.slice(at).reverse()];
    this.#aim(turned.map((key) => fitting.find((node) => node.key === key)).find(Boolean));
  }

  /** Arrow keys: on to the nearest box that fits in that direction. */
  aimInDirection(direction) {
    const from = this.canvas.scene.nodes.get(this.aimed ?? this.from);
    if (from) this.#aim(nearestInDirection(this.#fitting(), from, direction));
  }

  /** Letters: on to the next box whose name begins with what was typed. */
  aimByName(letter) {
    const now = performance.now();
    const goesOn = now - this.typed.time < TYPING_MS;
    this.typed = { text: (goesOn ? this.typed.text : "") + letter.toLowerCase(), time: now };
    this.#aim(this.#fitting().find(({ id }) => id.toLowerCase().startsWith(this.typed.text)));
    return true;
  }

  #fitting() {
    return [...this.canvas.scene.nodes.values()].filter((node) => this.gesture.accepts(node));
  }

  #aim(node) {
    if (!node) return;
    this.aimed = node.key;
    this.canvas.reveal(node.key);
    this.gesture.move({ world: { x: node.x, y: node.y } });
    this.canvas.painter.mark("drop", [node.key]);
    this.#say();
  }

  #say() {
    const target = this.canvas.scene.nodes.get(this.aimed);
    this.canvas.showMessage(target ? `${this.what} ${target.id}: Enter. Esc ends.` : `${this.what} …: click, or type its name. Esc ends.`);
  }
}
