// The columns of the table and what one cell looks like. Data only ever enters as text, never as markup.

/** `from` names the list that a choice is made from. */
export const COLUMNS = [
  { name: "name", title: "State or target", kind: "text" },
  { name: "initial", title: "Initial", kind: "flag" },
  { name: "final", title: "Final", kind: "flag" },
  { name: "disabled", title: "Disabled", kind: "flag" },
  { name: "when", title: "When", kind: "text", mono: true, hint: "always" },
  { name: "after", title: "After, s", kind: "text", mono: true },
  { name: "requires", title: "Requires", kind: "text", mono: true, from: "uses" },
  { name: "modulates", title: "Modulates", kind: "text", mono: true, from: "uses" },
  { name: "code", title: "Code", kind: "marks" },
  { name: "doc", title: "Doc", kind: "text" },
];

export const rowName = (row) => `${row.lead} ${row.cells.name ?? ""}`.trim();

const SIGNS = { error: "⬣", warning: "▲", note: "●" };

/** Whether a value of this column can be typed or chosen in this row. */
export function isEditable(row, column) {
  if (!(column.name in row.cells) || column.kind === "marks") return false;
  if (row.kind === "common") return false;
  return column.name !== "name" || ["state", "transition"].includes(row.kind);
}

/** How a cell is edited: a choice among the states, or a line (a doc: lines) of text. */
export function editorKind(row, column) {
  if (column.name === "name" && row.kind === "transition") return "choice";
  return column.name === "doc" || column.name === "when" ? "lines" : "line";
}

/** Fills a cell; returns what takes the focus for it. */
export function drawCell(cell, row, column) {
  const value = row.cells[column.name];
  cell.replaceChildren();
  cell.className = ["cell", `c-${column.name}`, column.mono ? "mono" : "", value === undefined ? "blank" : ""].join(" ").trim();
  cell.setAttribute("aria-readonly", String(!isEditable(row, column)));
  if (column.kind === "flag" && value !== undefined) return drawFlag(cell, row, column, value);
  if (column.name === "name") drawLead(cell, row);
  const text = span("text", value ?? "");
  // Only without any condition a transition is always taken.
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
  sign.setAttribute("aria-label", `${row.severity}: ${row.messages.join("; ")}`);
  cell.append(sign);
}

function span(name, text) {
  const element = document.createElement("span");
  element.className = name;
  element.textContent = text;
  return element;
}
