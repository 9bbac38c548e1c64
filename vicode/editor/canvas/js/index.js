// The door of the canvas: everything else is reached from here by relative imports.
export { mountCanvas } from "./canvas.js";
