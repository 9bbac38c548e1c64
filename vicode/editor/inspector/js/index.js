// Entry point of the forms that the browser draws.
export { FormNodes } from "./nodes.js";
export { FormStore, keyOf } from "./form_store.js";
