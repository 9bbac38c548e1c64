// Diagrams with pan, zoom and search.
const ZOOM_STEP = 1.25;
const PAN_STEP = 60;
const MAX_NODES_WITHOUT_SEARCH = 12;
const MAX_READABLE_SPAN = 1800;
const MAX_FADING_NODES = 40;

function fullscreenIcon() {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  svg.setAttribute("viewBox", "0 0 14 14");
  path.setAttribute("d", "M1 5V1h4M9 1h4v4M13 9v4H9M5 13H1V9");
  svg.append(path);
  return svg;
}

class DiagramViewer {
  constructor(frame) {
    this.frame = frame;
    this.viewport = frame.querySelector(".viewport");
    this.svg = frame.querySelector("svg");
    if (!this.svg) return;
    const [x, y, width, height] = this.svg.getAttribute("viewBox").split(" ").map(Number);
    this.fullView = { x, y, width, height };
    this.view = { ...this.fullView };
    this.nodes = new Map([...this.svg.querySelectorAll("[data-key]")].map((node) => [node.dataset.key, node]));
    this.focusedKey = null;
    frame.classList.toggle("is-large", this.nodes.size > MAX_FADING_NODES);
    frame.classList.add("is-interactive");
    this.addToolbar();
    this.addListeners();
  }

  addToolbar() {
    const tools = document.createElement("div");
    tools.className = "toolbar";
    if (this.nodes.size > MAX_NODES_WITHOUT_SEARCH) tools.append(...this.makeSearchField());
    const add = (sign, title, act, name = title) => {
      const button = document.createElement("button");
      button.type = "button";
      button.append(sign);
      button.title = title;
      button.setAttribute("aria-label", name);
      button.addEventListener("click", act);
      tools.append(button);
    };
    add("+", "Zoom in (+)", () => this.zoom(1 / ZOOM_STEP));
    add("−", "Zoom out (-)", () => this.zoom(ZOOM_STEP));
    add("Fit", "Zoom to fit (0)", () => this.fit(), "Fit: zoom to fit (0)");
    if (document.fullscreenEnabled) add(fullscreenIcon(), "Full screen (F)", () => this.toggleFullScreen());
    this.frame.prepend(tools);
  }

  // The search field zooms to a node and its neighbors.
  makeSearchField() {
    const field = document.createElement("input");
    const names = document.createElement("datalist");
    names.id = `names-${document.querySelectorAll("datalist").length}`;
    const keys = new Map([...this.nodes].map(([key, node]) => [node.querySelector("title").textContent.split("\n")[0], key]));
    names.append(...[...keys.keys()].sort((a, b) => a.localeCompare(b)).map((name) => new Option(name, name)));
    field.setAttribute("list", names.id);
    field.type = "search";
    field.placeholder = "Find in diagram";
    field.setAttribute("aria-label", field.placeholder);
    field.autocomplete = "off";
    field.spellcheck = false;
    const look = (isWhole) => {
      const text = field.value.trim().toLowerCase();
      const named = [...keys].filter(([name]) => (isWhole ? name.toLowerCase().includes(text) : name.toLowerCase() === text));
      if (!text) this.fit();
      else if (named.length) this.focusNode(named.sort(([a], [b]) => a.length - b.length)[0][1]);
    };
    field.addEventListener("input", () => look(false));
    field.addEventListener("keydown", (event) => {
      if (event.key === "Enter") look(true);
      if (event.key === "Escape") this.fit();
    });
    this.field = field;
    return [field, names];
  }

  // Shows as many neighbors as fit while the name stays readable.
  focusNode(key) {
    this.focusedKey = key;
    this.highlight(key);
    const own = this.nodes.get(key).getBBox();
    const boxes = [...this.nodes.values()].filter((node) => node.classList.contains("is-highlighted")).map((node) => node.getBBox());
    const ratio = this.fullView.width / this.fullView.height;
    const span = (start, size, most) => {
      const from = Math.min(...boxes.map((box) => box[start])) - 40;
      const to = Math.max(...boxes.map((box) => box[start] + box[size])) + 40;
      const middle = own[start] + own[size] / 2;
      return [Math.max(from, middle - most / 2), Math.min(to, middle + most / 2)];
    };
    const [left, right] = span("x", "width", MAX_READABLE_SPAN);
    const [top, bottom] = span("y", "height", MAX_READABLE_SPAN / ratio);
    const width = Math.max(right - left, (bottom - top) * ratio, 400);
    const height = width / ratio;
    this.view = { x: (left + right - width) / 2, y: (top + bottom - height) / 2, width, height };
    this.applyView();
  }

  addListeners() {
    this.viewport.addEventListener("keydown", (event) => this.onKey(event));
    // The wheel scrolls the page. With Ctrl, which a pinch gesture also sends, it zooms the diagram.
    this.viewport.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      this.zoom(Math.exp(Math.max(-60, Math.min(60, event.deltaY)) / 200), this.relativePoint(event));
    }, { passive: false });
    this.viewport.addEventListener("pointerdown", (event) => this.onPointerDown(event));
    this.svg.addEventListener("dragstart", (event) => event.preventDefault());
    for (const node of this.svg.querySelectorAll("[data-key]")) {
      node.addEventListener("pointerenter", () => this.highlight(node.dataset.key));
      node.addEventListener("pointerleave", () => this.highlight(null));
      node.addEventListener("focus", () => this.highlight(node.dataset.key));
      node.addEventListener("blur", () => this.highlight(null));
    }
  }

  applyView() {
    const { x, y, width, height } = this.view;
    this.svg.setAttribute("viewBox", `${x} ${y} ${width} ${height}`);
    this.frame.classList.toggle("is-zoomed", width < this.fullView.width * 0.99);
  }

  unitsPerPixel() {
    const rect = this.svg.getBoundingClientRect();
    return Math.max(this.view.width / rect.width, this.view.height / rect.height);
  }

  relativePoint(event) {
    const rect = this.svg.getBoundingClientRect();
    return { x: (event.clientX - rect.left) / rect.width, y: (event.clientY - rect.top) / rect.height };
  }

  // Shows the top left corner at natural size.
  showAtNaturalSize(height) {
    const width = this.viewport.clientWidth - 16;
    this.svg.setAttribute("width", width);
    this.svg.setAttribute("height", height);
    this.view = { x: this.fullView.x, y: this.fullView.y, width, height };
    this.applyView();
  }

  zoom(factor, at = { x: 0.5, y: 0.5 }) {
    const least = Math.min(this.fullView.width, 200);
    const width = Math.max(least, Math.min(this.fullView.width * 2, this.view.width * factor));
    const height = width * this.view.height / this.view.width;
    this.view.x += (this.view.width - width) * at.x;
    this.view.y += (this.view.height - height) * at.y;
    Object.assign(this.view, { width, height });
    this.applyView();
  }

  pan(dx, dy) {
    const scale = this.unitsPerPixel();
    this.view.x += dx * scale;
    this.view.y += dy * scale;
    this.applyView();
  }

  fit() {
    this.focusedKey = null;
    this.highlight(null);
    if (this.field) this.field.value = "";
    this.view = { ...this.fullView };
    this.applyView();
  }

  toggleFullScreen() {
    if (document.fullscreenElement) document.exitFullscreen();
    else this.frame.requestFullscreen();
  }

  onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const acts = {
      "+": () => this.zoom(1 / ZOOM_STEP), "=": () => this.zoom(1 / ZOOM_STEP), "-": () => this.zoom(ZOOM_STEP),
      0: () => this.fit(), f: () => this.toggleFullScreen(),
      ArrowLeft: () => this.pan(-PAN_STEP, 0), ArrowRight: () => this.pan(PAN_STEP, 0),
      ArrowUp: () => this.pan(0, -PAN_STEP), ArrowDown: () => this.pan(0, PAN_STEP),
    };
    if (!acts[event.key]) return;
    event.preventDefault();
    acts[event.key]();
  }

  onPointerDown(event) {
    // A finger pans the diagram if it is zoomed in, otherwise it scrolls the page.
    if (event.button !== 0 || (event.pointerType === "touch" && !this.frame.classList.contains("is-zoomed"))) return;
    let last = event;
    let moved = 0;
    const onMove = (next) => {
      moved += Math.abs(next.clientX - last.clientX) + Math.abs(next.clientY - last.clientY);
      if (moved > 4) {
        this.frame.classList.add("is-panning");
        this.pan(last.clientX - next.clientX, last.clientY - next.clientY);
      }
      last = next;
    };
    const onUp = () => {
      window.removeEventListener("pointermove", onMove);
      this.frame.classList.remove("is-panning");
      // Suppress the click at the end of a drag.
      if (moved > 4) {
        const stop = (click) => { click.preventDefault(); click.stopPropagation(); };
        this.svg.addEventListener("click", stop, { capture: true, once: true });
        setTimeout(() => this.svg.removeEventListener("click", stop, { capture: true }));
      }
    };
    window.addEventListener("pointermove", onMove);
    window.addEventListener("pointerup", onUp, { once: true });
  }

  highlight(asked) {
    const key = asked ?? this.focusedKey;
    this.svg.classList.toggle("has-highlight", key !== null);
    const lit = new Set();
    for (const each of this.svg.querySelectorAll("[data-from]")) {
      const isOf = key === each.dataset.from || key === each.dataset.to;
      each.classList.toggle("is-highlighted", isOf);
      if (isOf) lit.add(each.dataset.from).add(each.dataset.to);
    }
    lit.add(key);
    for (const each of this.svg.querySelectorAll("[data-key]")) each.classList.toggle("is-highlighted", lit.has(each.dataset.key));
  }
}

for (const frame of document.querySelectorAll("[data-diagram]")) new DiagramViewer(frame);
