// The door of the table: everything else is reached from here by relative imports.
export { mountTable } from "./table.js";
