// Keyboard handling of the table. Other keys are left to the page.

const STEPS = { ArrowUp: [-1, 0], ArrowDown: [1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] };
const MAX_STEPS = 1e6;

export function keyDown(table, event) {
  if (event.target.closest(".field-in-cell") || event.isComposing) return;
  const job = findHandler(table, event);
  if (!job) return;
  event.preventDefault();
  event.stopPropagation();
  job();
}

function findHandler(table, event) {
  const { row, column } = table.current;
  if (!row) return null;
  if (event.altKey) return findAltHandler(table, event, row);
  if (event.ctrlKey || event.metaKey) return findCtrlHandler(table, event, row);
  if (event.key in STEPS) return () => table.go(...STEPS[event.key]);
  const jobs = {
    Home: () => table.go(0, -MAX_STEPS),
    End: () => table.go(0, MAX_STEPS),
    PageUp: () => table.go(-table.page, 0),
    PageDown: () => table.go(table.page, 0),
    Enter: () => table.editOrToggle(),
    F2: () => table.editOrToggle(),
    Delete: () => clearCell(table, row, column),
    Backspace: () => clearCell(table, row, column),
  };
  if (event.key === " ") return column.kind === "flag" ? () => table.editOrToggle() : null;
  // Letters have no effect on a flag and must not trigger shortcuts of the page.
  if (column.kind === "flag" && /^\p{L}$/u.test(event.key)) return () => {};
  // A printable key replaces the text of the cell, as in a spreadsheet; a choice is only opened.
  if (event.key.length === 1) return () => table.editOrToggle({ text: column.name === "name" && row.kind === "transition" ? null : event.key });
  return jobs[event.key];
}

function findAltHandler(table, event, row) {
  const by = { ArrowUp: -1, ArrowDown: 1 }[event.key];
  return by && (() => table.report("move", { row: row.id, by }));
}

function findCtrlHandler(table, event, row) {
  const jobs = {
    Home: () => table.go(-MAX_STEPS, -MAX_STEPS),
    End: () => table.go(MAX_STEPS, MAX_STEPS),
    Enter: () => (event.shiftKey ? table.report("add-state", { row: row.id }) : table.report("add-transition", { row: row.id })),
    Delete: () => table.report("remove", { row: row.id }),
    Backspace: () => table.report("remove", { row: row.id }),
  };
  return jobs[event.key];
}

/** Deletes the row if its first cell is current; otherwise clears the cell. */
function clearCell(table, row, column) {
  if (column.name === "name") return table.report("remove", { row: row.id });
  const base = row.cells[column.name];
  if (typeof base !== "string" || !base || column.kind === "marks") return;
  table.report("set", { row: row.id, column: column.name, value: "", base });
}
