// Cell editor: a field over the cell. Python validates the edit; if it is refused, the text is kept.
import { COLUMNS, editorKind, rowName } from "./columns.js";

export class CellEditor {
  constructor(table) {
    this.table = table;
    this.field = null;
    this.errorBox = document.createElement("div");
    this.errorBox.className = "refused";
    this.errorBox.id = `refused-${table.host.id}`;
    this.errorBox.setAttribute("role", "alert");
    this.errorBox.hidden = true;
    table.scroller.append(this.errorBox);
  }

  get isOpen() {
    return this.field !== null;
  }

  /** Opens a cell; `text` replaces its text, `byMouse` also opens the list of a choice. */
  open(row, column, { text = null, byMouse = false, error = "" } = {}) {
    this.close(false);
    const cell = this.table.cellAt(row.id, column);
    if (!cell) return;
    this.row = row.id;
    this.column = column;
    this.base = row.cells[column.name];
    this.field = this.#build(row, column, text ?? this.base);
    cell.append(this.field);
    cell.classList.add("is-edited");
    this.#showError(error, cell);
    this.field.focus({ preventScroll: true });
    if (text === null || error) this.field.select?.();
    if (byMouse && this.field.tagName === "SELECT") this.#openList();
  }

  /** Closes the editor; `keep` reports the typed text as an edit. */
  close(keep) {
    if (!this.field) return;
    const { field, row, column, base } = this;
    this.field = null;
    field.parentElement?.classList.remove("is-edited");
    field.remove();
    this.errorBox.hidden = true;
    if (keep && field.value !== base) this.table.report("set", { row, column: column.name, value: field.value, base });
  }

  #build(row, column, text) {
    const kind = editorKind(row, column);
    const field = kind === "choice" ? this.#choice(text) : document.createElement(kind === "lines" ? "textarea" : "input");
    field.value = text;
    field.className = "field-in-cell";
    field.spellcheck = column.name === "doc";
    field.setAttribute("aria-label", `${column.title} of ${rowName(row)}`);
    if (kind === "lines") this.#growWith(field);
    if (column.from) field.placeholder = this.table.lists[column.from].join(", ");
    field.addEventListener("keydown", (event) => this.#onKeyDown(event));
    field.addEventListener("blur", () => this.field === field && this.close(true));
    field.addEventListener("pointerdown", (event) => event.stopPropagation());
    return field;
  }

  #choice(text) {
    const field = document.createElement("select");
    const names = this.table.lists.states;
    for (const name of names.includes(text) ? names : [text, ...names]) field.append(new Option(name, name));
    return field;
  }

  #growWith(field) {
    const grow = () => {
      field.style.height = "auto";
      field.style.height = `${Math.min(160, field.scrollHeight + 2)}px`;
    };
    field.rows = 1;
    field.addEventListener("input", grow);
    requestAnimationFrame(grow);
  }

  /** Opens the list. A choice by mouse is applied immediately; by keys only Enter applies it, since arrow keys change it too. */
  #openList() {
    const { field } = this;
    field.addEventListener("change", () => this.#closeAndFocus(true));
    try {
      field.showPicker();
    } catch {
      // Without a recent user gesture the browser refuses; the user can still click.
    }
  }

  #onKeyDown(event) {
    event.stopPropagation();
    if (event.isComposing) return;
    if (event.key === "Escape") this.#closeAndFocus(false);
    else if (event.key === "Enter" && !event.shiftKey) this.#closeAndFocus(true);
    else if (event.key === "Tab") {
      this.#closeAndFocus(true);
      this.table.moveToEditable(event.shiftKey ? -1 : 1);
    } else return;
    event.preventDefault();
  }

  #closeAndFocus(keep) {
    this.close(keep);
    this.table.focusGrid();
  }

  #showError(message, cell) {
    this.errorBox.textContent = message;
    this.errorBox.hidden = !message;
    if (!message) return;
    const { offsetLeft, offsetHeight } = cell;
    this.errorBox.style.left = `${offsetLeft}px`;
    this.errorBox.style.top = `${cell.parentElement.offsetTop + offsetHeight}px`;
    this.field.setAttribute("aria-invalid", "true");
    this.field.setAttribute("aria-describedby", this.errorBox.id);
  }
}

export const findColumn = (name) => COLUMNS.find((column) => column.name === name);
