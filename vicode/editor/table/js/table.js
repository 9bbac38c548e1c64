// The table: only visible rows are mounted, one cell is in the tab order, keys work as in a spreadsheet.
import { CellEditor, findColumn } from "./cell_editor.js";
import { COLUMNS, drawCell, isEditable } from "./columns.js";
import { keyDown } from "./keys.js";

const ROW = 32;
const MARGIN = 8;
const SELECT_MS = 120;

const sheet = new CSSStyleSheet();
sheet.replaceSync(await (await fetch(new URL("./table.css", import.meta.url))).text());
document.adoptedStyleSheets = [...document.adoptedStyleSheets, sheet];

/** Mounts a table in `host`; it reports events by `emit(event, payload)`. */
export const mountTable = (host, emit) => new Table(host, emit);

class Table {
  constructor(host, emit) {
    this.host = host;
    this.emit = emit;
    this.rows = new Map();
    this.order = [];
    this.mounted = new Map();
    this.selected = new Set();
    this.lists = { states: [], uses: [] };
    this.at = { row: null, column: 0 };
    this.#build();
    this.editor = new CellEditor(this);
    this.#addListeners();
  }

  load({ rows, states, uses }) {
    this.rows = new Map(rows.map((row) => [row.id, row]));
    this.lists = { states, uses };
    for (const element of this.mounted.values()) element.remove();
    this.mounted.clear();
    this.#reorder(rows.map((row) => row.id));
    this.host.dataset.ready = "true";
  }

  apply({ upsert, remove, order, ...lists }) {
    Object.assign(this.lists, lists);
    for (const id of remove) this.rows.delete(id);
    for (const row of upsert) this.rows.set(row.id, row);
    if (this.editor.isOpen && !this.rows.has(this.editor.row)) this.editor.close(false);
    const hadFocus = this.body.contains(document.activeElement) && !this.editor.isOpen;
    for (const row of upsert) if (this.mounted.has(row.id)) this.#drawRow(this.mounted.get(row.id), row);
    this.#reorder(order ?? this.order);
    if (hadFocus) this.focusGrid();
  }

  select(ids) {
    this.#markSelected(ids);
    const [first] = ids;
    // Typing is not interrupted.
    if (this.editor.isOpen || ids.length !== 1 || !this.rows.has(first) || first === this.at.row) return;
    this.#goTo(first, this.at.column, { quiet: true, focus: this.body.contains(document.activeElement) });
  }

  editCell(id, name, options = {}) {
    const row = this.rows.get(id);
    const column = findColumn(name);
    if (!row || !column) return;
    this.#goTo(id, COLUMNS.indexOf(column), { focus: true });
    if (isEditable(row, column) && column.kind !== "flag") this.editor.open(row, column, options);
  }

  /** An edit was refused: opens the cell with the typed text and the reason. */
  showError({ row, column, value }, message) {
    if (this.rows.has(row)) this.editCell(row, column, { text: value, error: message });
  }

  focusGrid() {
    if (!this.rows.has(this.at.row)) this.at = { row: this.order[0] ?? null, column: 0 };
    if (this.at.row === null) return this.scroller.focus();
    this.#goTo(this.at.row, this.at.column, { focus: true, quiet: true });
  }

  /** Moves the current cell by rows and columns, within the table. */
  go(rows, columns) {
    const last = this.order.length - 1;
    const index = Math.max(0, Math.min(last, this.order.indexOf(this.at.row) + rows));
    const column = Math.max(0, Math.min(COLUMNS.length - 1, this.at.column + columns));
    if (last >= 0) this.#goTo(this.order[index], column, { focus: true });
  }

  /** Moves to the next editable cell of the row; stays if there is none. */
  moveToEditable(step) {
    const row = this.rows.get(this.at.row);
    let column = this.at.column + step;
    while (row && COLUMNS[column] && !isEditable(row, COLUMNS[column])) column += step;
    if (COLUMNS[column]) this.go(0, column - this.at.column);
    else this.focusGrid();
  }

  /** Number of rows that Page Up and Page Down move. */
  get page() {
    return Math.max(1, Math.floor(this.scroller.clientHeight / ROW) - 2);
  }

  get current() {
    return { row: this.rows.get(this.at.row), column: COLUMNS[this.at.column] };
  }

  /** Opens the current cell for editing, or toggles a flag. */
  editOrToggle(options = {}) {
    const { row, column } = this.current;
    if (!row || !isEditable(row, column)) return;
    if (column.kind === "flag") this.report("toggle", { row: row.id, column: column.name });
    else this.editor.open(row, column, options);
  }

  /** Reports an event to Python, after a pending selection. */
  report(kind, fields) {
    this.#reportSelection();
    this.emit("event", { kind, ...fields });
  }

  cellAt(id, column) {
    this.#mount();
    return this.mounted.get(id)?.children[COLUMNS.indexOf(column)];
  }

  dispose() {
    clearTimeout(this.reportTimer);
    this.sizes.disconnect();
  }

  #build() {
    const make = (name, role, children = []) => {
      const element = document.createElement("div");
      element.className = name;
      element.setAttribute("role", role);
      element.append(...children);
      return element;
    };
    const heads = COLUMNS.map((column, index) => {
      const head = make(`head-cell c-${column.name}`, "columnheader");
      head.textContent = column.title;
      head.setAttribute("aria-colindex", String(index + 1));
      return head;
    });
    const headRow = make("head-row", "row", heads);
    headRow.setAttribute("aria-rowindex", "1");
    this.body = make("rows", "rowgroup");
    this.grid = make("grid", "treegrid", [make("heads", "rowgroup", [headRow]), this.body]);
    this.grid.setAttribute("aria-label", "States and transitions");
    this.grid.setAttribute("aria-colcount", String(COLUMNS.length));
    this.grid.setAttribute("aria-multiselectable", "true");
    this.scroller = make("scroller", "presentation", [this.grid]);
    this.host.append(this.scroller);
  }

  #addListeners() {
    this.scroller.addEventListener("scroll", () => this.#mount(), { passive: true });
    this.sizes = new ResizeObserver(() => this.#mount());
    this.sizes.observe(this.scroller);
    this.body.addEventListener("keydown", (event) => keyDown(this, event));
    this.body.addEventListener("pointerdown", (event) => this.#onPointerDown(event));
    this.body.addEventListener("dblclick", (event) => this.#findCell(event) && this.editOrToggle({ byMouse: true }));
    this.body.addEventListener("focusout", () => this.#reportSelection());
  }

  /** A press selects a cell; a press on the current cell opens it. */
  #onPointerDown(event) {
    const place = this.#findCell(event);
    if (!place || event.button !== 0) return;
    event.preventDefault();
    const again = place.row === this.at.row && place.column === this.at.column && this.body.contains(document.activeElement);
    this.#goTo(place.row, place.column, { focus: true });
    if (again || COLUMNS[place.column].kind === "flag") this.editOrToggle({ byMouse: true });
  }

  #findCell(event) {
    const cell = event.target.closest(".cell");
    if (!cell || event.target.closest(".field-in-cell")) return null;
    return { row: cell.parentElement.dataset.id, column: [...cell.parentElement.children].indexOf(cell) };
  }

  #goTo(id, column, { focus = false, quiet = false }) {
    if (this.editor.isOpen && (id !== this.editor.row || focus)) this.editor.close(true);
    this.#tab(-1);
    this.at = { row: id, column };
    this.#show(this.order.indexOf(id));
    this.#mount();
    this.#tab(0);
    if (focus) this.#focused()?.focus({ preventScroll: true });
    if (focus) this.#focused()?.scrollIntoView({ block: "nearest", inline: "nearest" });
    if (quiet) return;
    clearTimeout(this.reportTimer);
    this.reportTimer = setTimeout(() => this.#reportSelection(), SELECT_MS);
  }

  /** Reports the current row to Python. */
  #reportSelection() {
    if (!this.reportTimer) return;
    clearTimeout(this.reportTimer);
    this.reportTimer = null;
    if (!this.rows.has(this.at.row)) return;
    this.#markSelected([this.at.row]);
    this.report("select", { row: this.at.row });
  }

  #markSelected(ids) {
    this.selected = new Set(ids);
    for (const [id, element] of this.mounted) element.setAttribute("aria-selected", String(this.selected.has(id)));
  }

  #focused() {
    const cell = this.mounted.get(this.at.row)?.children[this.at.column];
    return cell?.querySelector(".flag") ?? cell;
  }

  #tab(index) {
    this.#focused()?.setAttribute("tabindex", String(index));
  }

  #show(index) {
    const top = index * ROW;
    const { scrollTop, clientHeight } = this.scroller;
    if (top < scrollTop) this.scroller.scrollTop = top;
    else if (top + 3 * ROW > scrollTop + clientHeight) this.scroller.scrollTop = top + 3 * ROW - clientHeight;
  }

  #reorder(order) {
    this.order = order.filter((id) => this.rows.has(id));
    this.grid.setAttribute("aria-rowcount", String(this.order.length + 1));
    this.body.style.height = `${this.order.length * ROW}px`;
    if (!this.rows.has(this.at.row)) this.#moveToNearestRow();
    this.#mount();
    this.#tab(0);
  }

  /** The current row was removed: selects the row at its position. */
  #moveToNearestRow() {
    const index = Math.max(0, Math.min(this.order.length - 1, this.index ?? 0));
    this.at = { row: this.order[index] ?? null, column: this.at.column };
  }

  /** Mounts the visible rows and the current row. */
  #mount() {
    const first = Math.max(0, Math.floor(this.scroller.scrollTop / ROW) - MARGIN);
    const last = Math.min(this.order.length, first + Math.ceil(this.scroller.clientHeight / ROW) + 2 * MARGIN);
    const own = this.order.indexOf(this.at.row);
    if (own >= 0) this.index = own;
    const wanted = [...new Set([own, ...range(first, last)])].filter((index) => index >= 0).sort((a, b) => a - b);
    const ids = new Set(wanted.map((index) => this.order[index]));
    for (const [id, element] of this.mounted) {
      if (ids.has(id)) continue;
      element.remove();
      this.mounted.delete(id);
    }
    let next = this.body.firstElementChild;
    for (const index of wanted) next = this.#place(index, next);
  }

  /** Inserts a row before `next`; returns the row that follows. */
  #place(index, next) {
    const id = this.order[index];
    const element = this.mounted.get(id) ?? this.#newRow(this.rows.get(id));
    element.style.top = `${index * ROW}px`;
    element.setAttribute("aria-rowindex", String(index + 2));
    if (element === next) return element.nextElementSibling;
    this.body.insertBefore(element, next);
    return next;
  }

  #newRow(row) {
    const element = document.createElement("div");
    element.setAttribute("role", "row");
    element.dataset.id = row.id;
    COLUMNS.forEach((_column, index) => {
      const cell = document.createElement("div");
      cell.setAttribute("role", "gridcell");
      cell.setAttribute("aria-colindex", String(index + 1));
      element.append(cell);
    });
    this.mounted.set(row.id, element);
    this.#drawRow(element, row);
    return element;
  }

  #drawRow(element, row) {
    element.className = `row ${row.kind}${row.cells.disabled ? " is-disabled" : ""}`;
    element.style.setProperty("--level", String(row.level - 1));
    element.setAttribute("aria-level", String(row.level));
    element.setAttribute("aria-selected", String(this.selected.has(row.id)));
    COLUMNS.forEach((column, index) => {
      const cell = element.children[index];
      const isEdited = this.editor.isOpen && this.editor.row === row.id && this.editor.column === column;
      if (isEdited) return;
      drawCell(cell, row, column).setAttribute("tabindex", "-1");
    });
    if (row.id === this.at.row) this.#tab(0);
  }
}

function* range(from, to) {
  for (let index = from; index < to; index += 1) yield index;
}
