// The columns of the table and how cells are drawn. Data is only set as text, never as markup.

/** `from`: name of the list of possible values. */
export const COLUMNS = [
  { name: "name", title: "State or target", kind: "text" },
  { name: "initial", title: "Initial", kind: "flag" },
  { name: "final", title: "Final", kind: "flag" },
  { name: "disabled", title: "Disabled", kind: "flag" },
  { name: "when", title: "When", kind: "text", mono: true, hint: "always" },
  { name: "after", title: "After", kind: "text", mono: true },
  { name: "requires", title: "Requires", kind: "text", mono: true, from: "uses" },
  { name: "modulates", title: "Modulates", kind: "text", mono: true, from: "uses" },
  { name: "code", title: "Code", kind: "marks" },
  { name: "doc", title: "Description", kind: "text" },
];

export const rowName = (row) => `${row.lead} ${row.cells.name ?? ""}`.trim();

const SIGNS = { error: "⬣", warning: "▲", note: "●" };

/** Whether a cell is editable. */
export function isEditable(row, column) {
  if (!(column.name in row.cells) || column.kind === "marks") return false;
  if (row.kind === "common") return false;
  return column.name !== "name" || ["state", "transition"].includes(row.kind);
}

/** Returns the kind of editor of a cell: "choice" of a state, a "line" or several "lines" of text. */
export function editorKind(row, column) {
  if (column.name === "name" && row.kind === "transition") return "choice";
  return column.name === "doc" || column.name === "when" ? "lines" : "line";
}

/** Draws a cell; returns the element that receives the focus. */
export function drawCell(cell, row, column) {
  const value = row.cells[column.name];
  cell.replaceChildren();
  cell.className = ["cell", `c-${column.name}`, column.mono ? "mono" : "", value === undefined ? "blank" : ""].join(" ").trim();
  cell.setAttribute("aria-readonly", String(!isEditable(row, column)));
  if (column.kind === "flag" && value !== undefined) return drawFlag(cell, row, column, value);
  if (column.name === "name") drawLead(cell, row);
  const text = span("text", value ?? "");
  // Only a transition without any condition is always taken.
  if (column.hint && value === "" && !row.cells.when && !row.cells.after && !row.cells.code) text.dataset.hint = column.hint;
  cell.append(text);
  cell.title = column.name === "name" && row.messages.length ? row.messages.join("\n") : (value ?? "");
  return cell;
}

function drawFlag(cell, row, column, value) {
  const box = span("flag", "");
  box.setAttribute("role", "checkbox");
  box.setAttribute("aria-checked", String(value));
  box.setAttribute("aria-label", `${rowName(row)}: ${column.title}`);
  cell.title = column.title;
  cell.append(box);
  return box;
}

function drawLead(cell, row) {
  if (row.lead) cell.append(span("lead", row.lead));
  if (!row.severity) return;
  const sign = span(`sign ${row.severity}`, SIGNS[row.severity] ?? "●");
  sign.setAttribute("role", "img");
  sign.setAttribute("aria-label", row.messages.join("; "));
  cell.append(sign);
}

function span(name, text) {
  const element = document.createElement("span");
  element.className = name;
  element.textContent = text;
  return element;
}
