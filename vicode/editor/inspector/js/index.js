// Entry point of the forms that the browser draws.
export { FORM_NODES } from "./nodes.js";
export { FormStore, keyOf } from "./form_store.js";
