// Typing in a cell: a field laid over it. What is typed is only proposed; Python decides, and a refusal keeps it.
import { COLUMNS, editorKind, rowName } from "./columns.js";

export class CellEditor {
  constructor(table) {
    this.table = table;
    this.field = null;
    this.words = document.createElement("div");
    this.words.className = "refused";
    this.words.id = `refused-${table.host.id}`;
    this.words.setAttribute("role", "alert");
    this.words.hidden = true;
    table.scroller.append(this.words);
  }

  get isOpen() {
    return this.field !== null;
  }

  /** Opens a cell; `text` replaces what stands in it, `byMouse` opens a list at once. */
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

  /** Ends the typing; `keep` proposes what was typed. */
  close(keep) {
    if (!this.field) return;
    const { field, row, column, base } = this;
    this.field = null;
    field.parentElement?.classList.remove("is-edited");
    field.remove();
    this.words.hidden = true;
    if (keep && field.value !== base) this.table.emit("edit", { kind: "set", row, column: column.name, value: field.value, base });
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

  /** A list opened by hand takes what is picked at once; by keys Enter does, as every arrow would be an edit. */
  #openList() {
    const { field } = this;
    field.addEventListener("change", () => this.#closeAndFocus(true));
    try {
      field.showPicker();
    } catch {
      // Without a fresh gesture a browser keeps it shut; it can still be opened by a click.
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

  #showError(words, cell) {
    this.words.textContent = words;
    this.words.hidden = !words;
    if (!words) return;
    const { offsetLeft, offsetHeight } = cell;
    this.words.style.left = `${offsetLeft}px`;
    this.words.style.top = `${cell.parentElement.offsetTop + offsetHeight}px`;
    this.field.setAttribute("aria-invalid", "true");
    this.field.setAttribute("aria-describedby", this.words.id);
  }
}

export const findColumn = (name) => COLUMNS.find((column) => column.name === name);
