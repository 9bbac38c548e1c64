// Entry point of the table.
export { mountTable } from "./table.js";
