// Entry point of the canvas: imports all other modules by relative paths.
export { mountCanvas } from "./canvas.js";
