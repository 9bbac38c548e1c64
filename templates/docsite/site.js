/* vicode docs: search, and drawings that can be moved. Without it every page can be read all the same. */
(() => {
  "use strict";

  const MOST_FOUND = 30;
  const ZOOM_STEP = 1.25;
  const PAN_STEP = 60;
  const MOST_SEEN_AT_ONCE = 12;
  const MOST_READABLE = 1800;
  const MOST_FADING = 40;
  const TALLEST = 640;

  // ---- Search ----

  const box = document.querySelector(".search");
  const field = document.getElementById("search");
  const list = document.getElementById("found");
  let chosen = 0;
  let loading = null;

  function loadEntries() {
    loading ??= new Promise((resolve) => {
      const script = document.createElement("script");
      script.src = "search.js";
      script.onload = () => resolve(unpacked(window.vicodeIndex));
      document.head.append(script);
    });
    return loading;
  }

  // Entries as [name, kind, where, address, doc, pieces of code]; what they share is written once.
  function unpacked({ kinds, places, pages, pieces, entries }) {
    return entries.map(([name, kind, where, page, anchor = 0, doc = "", words = []]) => {
      const place = anchor === 0 ? `${kinds[kind]}-${name}` : anchor;
      const code = words.map((number) => pieces[number]);
      return [name, kinds[kind], places[where], pages[page] + (place ? `#${place}` : ""), doc, code];
    });
  }

  // The better the earlier: the name, its beginning, its inside, then docs, then code. Every word must be somewhere.
  function rank(entry, words) {
    let worst = 0;
    const [name, kind, where, , doc, code] = entry.map((text) => text.toString().toLowerCase());
    for (const word of words) {
      let place = 6;
      if (name === word) place = 0;
      else if (name.startsWith(word)) place = 1;
      else if (name.includes(word)) place = 2;
      else if (kind === word || where.includes(word)) place = 3;
      else if (doc.includes(word)) place = 4;
      else if (code.includes(word)) place = 5;
      worst = Math.max(worst, place);
    }
    return worst;
  }

  function find(entries, text) {
    const words = text.toLowerCase().split(/\s+/).filter(Boolean);
    if (!words.length) return [];
    return entries
      .map((entry, index) => ({ entry, index, rank: rank(entry, words) }))
      .filter((each) => each.rank < 6)
      .sort((a, b) => a.rank - b.rank || a.index - b.index)
      .slice(0, MOST_FOUND)
      .map((each) => each.entry);
  }

  // The doc, or the guard or line of code, that says most of the words, around the first of them; and whether it is code.
  function excerpt(entry, text) {
    const [name, kind, where, , doc, code] = entry;
    const words = text.toLowerCase().split(/\s+/).filter((word) => word && !name.toLowerCase().includes(word));
    const said = (body) => words.filter((word) => body.toLowerCase().includes(word));
    const best = [doc, ...code].reduce((one, other) => (said(other).length > said(one).length ? other : one));
    // Of what is part of another thing the line above says of which.
    if (!said(best).length) return [cut(doc, 0) || (isWhole(kind) ? where : ""), false];
    const at = Math.min(...said(best).map((word) => best.toLowerCase().indexOf(word)));
    const start = at > 60 || best.length > 140 ? Math.max(0, at - 40) : 0;
    return [(start ? "… " : "") + cut(best, start), best !== doc];
  }

  const isWhole = (kind) => ["component", "interface"].includes(kind);

  // From a place on, to the last whole word that there is room for.
  function cut(text, start) {
    const end = start + 140;
    return text.length <= end ? text.slice(start) : `${text.slice(start, end).replace(/\s+\S*$/, "")} …`;
  }

  // A text with the words that were looked for marked in it.
  function marked(body, text) {
    const words = text.split(/\s+/).filter(Boolean).map((word) => word.replace(/[.*+?^${}()|[\]\\]/g, "\\$&"));
    return body.split(new RegExp(`(${words.join("|")})`, "i")).map((part, at) => {
      if (at % 2 === 0) return part;
      const mark = document.createElement("mark");
      mark.textContent = part;
      return mark;
    });
  }

  function row(entry, index, text) {
    const item = document.createElement("li");
    item.id = `found-${index}`;
    item.role = "option";
    const name = document.createElement("bdi");
    name.append(...marked(entry[0], text));
    const kind = document.createElement("span");
    kind.className = "kind";
    kind.textContent = isWhole(entry[1]) ? entry[1] : `${entry[1]} of ${entry[2]}`;
    const [said, isCode] = excerpt(entry, text);
    const about = document.createElement(isCode ? "code" : "span");
    about.className = "about";
    about.append(...marked(said, text));
    item.append(kind, name, about);
    item.addEventListener("mousedown", (event) => event.preventDefault());
    item.addEventListener("click", () => go(entry[3]));
    return item;
  }

  function go(address) {
    close();
    field.blur();
    location.href = address;
  }

  function close() {
    list.hidden = true;
    field.setAttribute("aria-expanded", "false");
    field.removeAttribute("aria-activedescendant");
  }

  function choose(index) {
    const items = [...list.querySelectorAll("[role=option]")];
    if (!items.length) return;
    chosen = (index + items.length) % items.length;
    items.forEach((item, at) => item.setAttribute("aria-selected", String(at === chosen)));
    items[chosen].scrollIntoView({ block: "nearest" });
    field.setAttribute("aria-activedescendant", items[chosen].id);
  }

  async function search() {
    const text = field.value;
    const entries = await loadEntries();
    if (text !== field.value) return;
    const found = find(entries, text);
    list.replaceChildren(...found.map((entry, index) => row(entry, index, text)));
    if (text.trim() && !found.length) {
      const item = document.createElement("li");
      item.className = "nothing";
      item.textContent = "Nothing is called so, or says so.";
      list.append(item);
    }
    list.hidden = !text.trim();
    field.setAttribute("aria-expanded", String(!list.hidden));
    choose(0);
  }

  function onSearchKey(event) {
    if (event.key === "ArrowDown") choose(chosen + 1);
    else if (event.key === "ArrowUp") choose(chosen - 1);
    else if (event.key === "Enter") list.querySelector("[aria-selected=true]")?.click();
    else if (event.key === "Escape") { close(); field.value = ""; field.blur(); }
    else return;
    event.preventDefault();
  }

  if (box) {
    box.hidden = false;
    // Where there is little room there is no key either.
    if (matchMedia("(max-width: 800px)").matches) field.placeholder = "Search";
    field.addEventListener("focus", loadEntries);
    field.addEventListener("input", search);
    field.addEventListener("keydown", onSearchKey);
    field.addEventListener("blur", close);
    document.addEventListener("keydown", (event) => {
      const isTyping = event.target.closest?.("input, textarea, select");
      if (isTyping || event.ctrlKey || event.metaKey || event.altKey || event.key !== "/") return;
      event.preventDefault();
      field.focus();
    });
  }

  // ---- Drawings ----

  function frameSign() {
    const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
    svg.setAttribute("viewBox", "0 0 14 14");
    path.setAttribute("d", "M1 5V1h4M9 1h4v4M13 9v4H9M5 13H1V9");
    svg.append(path);
    return svg;
  }

  class Drawing {
    constructor(frame) {
      this.frame = frame;
      this.sheet = frame.querySelector(".sheet");
      this.svg = frame.querySelector("svg");
      if (!this.svg) return;
      const [x, y, width, height] = this.svg.getAttribute("viewBox").split(" ").map(Number);
      this.whole = { x, y, width, height };
      this.view = { ...this.whole };
      this.nodes = new Map([...this.svg.querySelectorAll("[data-key]")].map((node) => [node.dataset.key, node]));
      this.held = null;
      frame.classList.toggle("is-large", this.nodes.size > MOST_FADING);
      frame.classList.add("is-live");
      this.addTools();
      this.listen();
    }

    addTools() {
      const tools = document.createElement("div");
      tools.className = "tools";
      if (this.nodes.size > MOST_SEEN_AT_ONCE) tools.append(...this.finder());
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
      add("Fit", "Show all of it (0)", () => this.fit(), "Fit: show all of it (0)");
      if (document.fullscreenEnabled) add(frameSign(), "Full screen (F)", () => this.toggleFullScreen());
      this.frame.prepend(tools);
    }

    // A field that shows a box large, with all that are joined to it.
    finder() {
      const field = document.createElement("input");
      const names = document.createElement("datalist");
      names.id = `names-${document.querySelectorAll("datalist").length}`;
      const keys = new Map([...this.nodes].map(([key, node]) => [node.querySelector("title").textContent.split("\n")[0], key]));
      names.append(...[...keys.keys()].sort((a, b) => a.localeCompare(b)).map((name) => new Option(name, name)));
      field.setAttribute("list", names.id);
      field.type = "search";
      field.placeholder = "Find in the drawing";
      field.setAttribute("aria-label", field.placeholder);
      field.autocomplete = "off";
      field.spellcheck = false;
      const look = (isWhole) => {
        const text = field.value.trim().toLowerCase();
        const named = [...keys].filter(([name]) => (isWhole ? name.toLowerCase().includes(text) : name.toLowerCase() === text));
        if (!text) this.fit();
        else if (named.length) this.hold(named.sort(([a], [b]) => a.length - b.length)[0][1]);
      };
      field.addEventListener("input", () => look(false));
      field.addEventListener("keydown", (event) => {
        if (event.key === "Enter") look(true);
        if (event.key === "Escape") this.fit();
      });
      this.field = field;
      return [field, names];
    }

    // Its neighbors are in the view as far as its name can be read then.
    hold(key) {
      this.held = key;
      this.light(key);
      const own = this.nodes.get(key).getBBox();
      const boxes = [...this.nodes.values()].filter((node) => node.classList.contains("is-lit")).map((node) => node.getBBox());
      const ratio = this.whole.width / this.whole.height;
      const span = (start, size, most) => {
        const from = Math.min(...boxes.map((box) => box[start])) - 40;
        const to = Math.max(...boxes.map((box) => box[start] + box[size])) + 40;
        const middle = own[start] + own[size] / 2;
        return [Math.max(from, middle - most / 2), Math.min(to, middle + most / 2)];
      };
      const [left, right] = span("x", "width", MOST_READABLE);
      const [top, bottom] = span("y", "height", MOST_READABLE / ratio);
      const width = Math.max(right - left, (bottom - top) * ratio, 400);
      const height = width / ratio;
      this.view = { x: (left + right - width) / 2, y: (top + bottom - height) / 2, width, height };
      this.show();
    }

    listen() {
      this.sheet.addEventListener("keydown", (event) => this.onKey(event));
      // The page scrolls by the wheel; with Ctrl, as a pinch says too, the drawing zooms.
      this.sheet.addEventListener("wheel", (event) => {
        if (!event.ctrlKey && !event.metaKey) return;
        event.preventDefault();
        this.zoom(Math.exp(Math.max(-60, Math.min(60, event.deltaY)) / 200), this.pointOf(event));
      }, { passive: false });
      this.sheet.addEventListener("pointerdown", (event) => this.onDown(event));
      this.svg.addEventListener("dragstart", (event) => event.preventDefault());
      for (const node of this.svg.querySelectorAll("[data-key]")) {
        node.addEventListener("pointerenter", () => this.light(node.dataset.key));
        node.addEventListener("pointerleave", () => this.light(null));
        node.addEventListener("focus", () => this.light(node.dataset.key));
        node.addEventListener("blur", () => this.light(null));
      }
    }

    show() {
      const { x, y, width, height } = this.view;
      this.svg.setAttribute("viewBox", `${x} ${y} ${width} ${height}`);
      this.frame.classList.toggle("is-zoomed", width < this.whole.width * 0.99);
    }

    pixels() {
      const rect = this.svg.getBoundingClientRect();
      return Math.max(this.view.width / rect.width, this.view.height / rect.height);
    }

    pointOf(event) {
      const rect = this.svg.getBoundingClientRect();
      return { x: (event.clientX - rect.left) / rect.width, y: (event.clientY - rect.top) / rect.height };
    }

    // In its own size from its upper left corner on.
    begin(height) {
      const width = this.sheet.clientWidth - 16;
      this.svg.setAttribute("width", width);
      this.svg.setAttribute("height", height);
      this.view = { x: this.whole.x, y: this.whole.y, width, height };
      this.show();
    }

    zoom(factor, at = { x: 0.5, y: 0.5 }) {
      const least = Math.min(this.whole.width, 200);
      const width = Math.max(least, Math.min(this.whole.width * 2, this.view.width * factor));
      const height = width * this.view.height / this.view.width;
      this.view.x += (this.view.width - width) * at.x;
      this.view.y += (this.view.height - height) * at.y;
      Object.assign(this.view, { width, height });
      this.show();
    }

    pan(dx, dy) {
      const scale = this.pixels();
      this.view.x += dx * scale;
      this.view.y += dy * scale;
      this.show();
    }

    fit() {
      this.held = null;
      this.light(null);
      if (this.field) this.field.value = "";
      this.view = { ...this.whole };
      this.show();
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

    onDown(event) {
      // A finger scrolls the page while all of the drawing is shown, and moves the drawing when it is not.
      if (event.button !== 0 || (event.pointerType === "touch" && !this.frame.classList.contains("is-zoomed"))) return;
      let last = event;
      let moved = 0;
      const onMove = (next) => {
        moved += Math.abs(next.clientX - last.clientX) + Math.abs(next.clientY - last.clientY);
        if (moved > 4) {
          this.frame.classList.add("is-moving");
          this.pan(last.clientX - next.clientX, last.clientY - next.clientY);
        }
        last = next;
      };
      const onUp = () => {
        window.removeEventListener("pointermove", onMove);
        this.frame.classList.remove("is-moving");
        // The click that ends a drag follows no link.
        if (moved > 4) {
          const stop = (click) => { click.preventDefault(); click.stopPropagation(); };
          this.svg.addEventListener("click", stop, { capture: true, once: true });
          setTimeout(() => this.svg.removeEventListener("click", stop, { capture: true }));
        }
      };
      window.addEventListener("pointermove", onMove);
      window.addEventListener("pointerup", onUp, { once: true });
    }

    light(asked) {
      const key = asked ?? this.held;
      this.svg.classList.toggle("is-asked", key !== null);
      const lit = new Set();
      for (const each of this.svg.querySelectorAll("[data-from]")) {
        const isOf = key === each.dataset.from || key === each.dataset.to;
        each.classList.toggle("is-lit", isOf);
        if (isOf) lit.add(each.dataset.from).add(each.dataset.to);
      }
      lit.add(key);
      for (const each of this.svg.querySelectorAll("[data-key]")) each.classList.toggle("is-lit", lit.has(each.dataset.key));
    }
  }

  for (const frame of document.querySelectorAll("[data-drawing]")) new Drawing(frame);

  // ---- Decision trees: a box and the line of pseudo code that says the same are shown together ----

  for (const section of document.querySelectorAll(".state")) {
    const light = (key, on) => {
      for (const node of section.querySelectorAll(".tree [data-key]")) if (node.dataset.key === key) node.classList.toggle("is-lit", on);
      document.getElementById(key)?.classList.toggle("is-lit", on);
    };
    for (const each of section.querySelectorAll(".tree [data-key], .pseudo li[id]")) {
      const key = each.dataset.key ?? each.id;
      for (const [event, on] of [["pointerenter", true], ["pointerleave", false], ["focusin", true], ["focusout", false]]) {
        each.addEventListener(event, () => light(key, on));
      }
    }
  }

  // One that is little wider than its place is shown a little smaller. A wide one gets the tools of a drawing, and begins
  // in its own size; a finger moves it as it moves the page.
  const hasPointer = matchMedia("(pointer: fine)").matches;
  const trees = [...document.querySelectorAll(".tree")].map((tree) => ({ tree, room: tree.clientWidth, width: tree.scrollWidth }));
  for (const { tree, room, width } of trees) {
    if (width <= room) continue;
    if (width < room * 1.4 || !hasPointer) tree.classList.toggle("is-fitted", width < room * 1.4);
    else makeMovable(tree);
  }

  function makeMovable(tree) {
    const sheet = document.createElement("div");
    sheet.className = "sheet";
    for (const name of ["tabindex", "role", "aria-label"]) {
      sheet.setAttribute(name, tree.getAttribute(name));
      tree.removeAttribute(name);
    }
    sheet.append(...tree.childNodes);
    tree.append(sheet);
    tree.classList.add("drawing");
    new Drawing(tree).begin(Math.min(TALLEST, Number(sheet.querySelector("svg").getAttribute("height"))));
  }

  function showTarget() {
    const key = decodeURIComponent(location.hash.slice(1));
    for (const node of document.querySelectorAll(".tree [data-key]")) node.classList.toggle("is-target", node.dataset.key === key);
  }
  window.addEventListener("hashchange", showTarget);
  showTarget();

  // Of a long menu the part with this page is shown.
  const menu = document.querySelector(".menu");
  const here = menu?.querySelector("[aria-current]");
  if (here && here.offsetTop + here.offsetHeight > menu.clientHeight) menu.scrollTop = here.offsetTop - menu.clientHeight / 2;

  // Wide screens show the menu without opening it, where the style sheet can say so.
  const showsClosed = window.CSS?.supports?.("selector(::details-content)");
  if (!showsClosed && matchMedia("(min-width: 801px)").matches) document.querySelector(".menu details").open = true;
})();
