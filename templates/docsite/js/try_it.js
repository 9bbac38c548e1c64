// Runs a design with its generated code: inputs, steps, and what is active. Nothing here knows the rules of designs.
const MAX_STEPS_PER_FRAME = 200;

function el(tag, props = {}, ...children) {
  const node = Object.assign(document.createElement(tag), props);
  node.append(...children);
  return node;
}

function shown(value) {
  if (typeof value === "string") return value.slice(value.indexOf(".") + 1);
  return typeof value === "number" ? String(Number(value.toPrecision(5))) : String(value);
}

const seconds = (ns) => `${(ns / 1e9).toFixed(3)} s`;

function makeValues(pairs) {
  return el("span", { className: "try-reads" }, pairs.map(([name, value]) => `${name} = ${shown(value)}`).join(" · "));
}

/** A whole power of ten that divides a range into 100 to 1000 parts. */
const stepOf = ([low, high]) => 10 ** Math.floor(Math.log10((high - low) / 100));

class TryIt {
  constructor(design) {
    this.design = design;
    this.values = new Map();
    this.build();
    this.reset();
  }

  build() {
    this.runButton = el("button", { type: "button", onclick: () => this.toggleRun() }, "Run");
    this.rate = el("select", { id: "try-rate" }, ...[0.25, 1, 4, 16].map((rate) => new Option(`${rate} ×`, rate, rate === 1, rate === 1)));
    this.time = el("span", { className: "try-time" });
    this.last = el("p", { className: "try-last" });
    this.last.setAttribute("role", "status");
    this.guards = el("ol", { className: "try-guards" });
    this.guardTitle = el("h3");
    this.rows = el("tbody");
    const head = el("thead", {}, el("tr", {}, ...["Component", "Active state"].map((text) => el("th", { scope: "col" }, text))));
    document.getElementById("try").append(
      el(
        "div", { className: "try-bar" },
        el("button", { type: "button", title: `One iteration: ${seconds(this.design.stepNs)}`, onclick: () => this.run(1) }, "Step"),
        this.runButton,
        el("label", { htmlFor: "try-rate" }, "Rate"), this.rate,
        el("button", { type: "button", onclick: () => this.reset() }, "Reset"),
        this.time,
      ),
      this.last,
      el(
        "div", { className: "try-columns" },
        el("div", {}, el("h3", {}, "Inputs"), ...this.makeInputs()),
        el("div", {}, this.guardTitle, this.guards, el("h3", {}, "Components"), el("table", {}, head, this.rows)),
      ),
    );
  }

  makeInputs() {
    const root = new bica.Root();
    const groups = new Map();
    this.design.inputs.forEach((input, index) => {
      const start = root.component(this.design.classes[input.component])[input.name];
      this.values.set(input, input.isFunction ? start({}) : start);
      const group = groups.get(input.component) ?? groups.set(input.component, []).get(input.component);
      group.push(...this.makeInput(input, `try-input-${index}`));
    });
    if (!groups.size) return [el("p", { className: "secondary" }, "This design reads no inputs.")];
    const main = this.design.parts[0][0];
    return this.design.parts.filter(([component]) => groups.has(component)).map(([component, label]) => (
      el("fieldset", {}, el("legend", {}, component === main ? "Parameters" : label), el("div", { className: "try-inputs" }, ...groups.get(component)))
    ));
  }

  /** A label, the field, and its unit; a slider also shows its value. */
  makeInput(input, id) {
    const note = el("span", { className: "try-value", id: `${id}-value` });
    const tell = () => {
      const value = input.range ? shown(this.values.get(input)) : "";
      note.textContent = `${value} ${input.unit}`.trim();
    };
    const field = this.makeField(input, this.values.get(input), (value) => {
      this.values.set(input, value);
      tell();
      this.applyInputs();
      this.showGuards();
    });
    field.id = id;
    field.setAttribute("aria-describedby", note.id);
    tell();
    const name = input.isFunction ? `${input.label}(…)` : input.label;
    return [el("label", { htmlFor: id }, name), field, note];
  }

  makeField({ type, options, range }, value, set) {
    if (options.length) {
      const choices = options.map((each) => new Option(shown(each), each, each === value, each === value));
      return el("select", { onchange: (event) => set(event.target.value) }, ...choices);
    }
    if (type === "bool") return el("input", { type: "checkbox", checked: value, onchange: (event) => set(event.target.checked) });
    const [min, max] = range ?? ["", ""];
    const step = type === "int" ? 1 : range ? stepOf(range) : "any";
    const field = el("input", { type: range ? "range" : "number", min, max, step, value });
    field.addEventListener("input", () => {
      const number = field.valueAsNumber;
      if (!Number.isNaN(number)) set(type === "int" ? bica.toInt(number) : number);
    });
    return field;
  }

  applyInputs() {
    for (const [input, value] of this.values) {
      this.parts.get(input.component)[input.name] = input.isFunction ? () => value : value;
    }
  }

  reset() {
    this.pause();
    this.root = new bica.Root();
    this.parts = new Map(this.design.parts.map(([name]) => [name, this.root.component(this.design.classes[name])]));
    [this.main] = this.parts.values();
    this.clockNs = 0;
    this.records = [];
    this.lastTransition = null;
    this.applyInputs();
    this.show();
  }

  iterate() {
    this.root.trace = this.records = [];
    this.root.step(this.main, this.clockNs);
    const [own] = this.records;
    if (own.changed_from !== null) this.lastTransition = { from: own.changed_from, to: own.state, id: own.transition, ns: this.clockNs };
    this.clockNs += this.design.stepNs;
  }

  run(steps) {
    for (let count = 0; count < Math.min(steps, MAX_STEPS_PER_FRAME); count += 1) this.iterate();
    if (steps > 0) this.show();
  }

  toggleRun() {
    if (this.frame) return this.pause();
    this.runButton.textContent = "Pause";
    let before = performance.now();
    let rest = 0;
    const advance = (now) => {
      rest += (now - before) * 1e6 * Number(this.rate.value);
      before = now;
      this.run(Math.floor(rest / this.design.stepNs));
      rest %= this.design.stepNs;
      this.frame = requestAnimationFrame(advance);
    };
    this.frame = requestAnimationFrame(advance);
  }

  pause() {
    cancelAnimationFrame(this.frame);
    this.frame = null;
    this.runButton.textContent = "Run";
  }

  show() {
    this.time.textContent = this.root.iteration ? seconds(this.root.nowNs) : "Not started";
    const name = (state) => this.design.states[state][1];
    const { from, to, ns } = this.lastTransition ?? {};
    const last = from ? ` Last transition: ${name(from)} → ${name(to)} at ${seconds(ns)}.` : "";
    const text = `Active state: ${name(this.main.$state)}.${last}`;
    // Screen readers read each change.
    if (this.last.textContent !== text) this.last.textContent = text;
    this.showDiagram();
    this.showGuards();
    this.showParts();
  }

  showDiagram() {
    const [anchor] = this.design.states[this.main.$state];
    const last = this.lastTransition && `#${this.lastTransition.id}`;
    for (const link of document.querySelector(".diagram").querySelectorAll("a")) {
      const href = link.getAttribute("href");
      link.classList.toggle("is-active", link.classList.contains("state") && href === anchor);
      link.classList.toggle("is-last", link.classList.contains("transition") && href === last);
    }
  }

  showGuards() {
    const state = this.main.$state;
    this.guardTitle.textContent = `Guards of ${this.design.states[state][1]}`;
    const guards = [...this.design.guards["@common"], ...this.design.guards[state]];
    this.guards.replaceChildren(...guards.map((guard) => this.makeGuard(guard)));
    if (!guards.length) this.guards.append(el("li", { className: "secondary" }, "The state has no transitions."));
  }

  makeGuard({ id, test, reads }) {
    const holds = test?.call(this.main);
    const text = document.getElementById(id)?.querySelector("code")?.cloneNode(true) ?? el("code", {}, id);
    const mark = el("span", { className: "try-mark" }, test ? String(holds) : "always");
    const values = Object.entries(reads).map(([name, read]) => [name, read.call(this.main)]);
    return el("li", { className: holds ? "holds" : "" }, mark, el("div", {}, text, makeValues(values)));
  }

  showParts() {
    this.rows.replaceChildren(...this.design.parts.map(([name, label, href]) => {
      const { $name, $states } = this.parts.get(name);
      const record = this.records.findLast((each) => each.component === $name);
      const values = Object.entries(($states ? record?.values : record?.parameters) ?? {});
      const state = el("span", { className: $states && record ? "try-state" : "" }, record ? ($states ? record.state : "stepped") : "–");
      const cells = [el("th", { scope: "row" }, el("a", { href }, label)), el("td", {}, state, makeValues(values))];
      return el("tr", { className: record ? "" : "muted" }, ...cells);
    }));
  }
}

window.vicodeTry = (load) => {
  const button = document.getElementById("try-button");
  const isOnly = location.hash === "#try-only";
  const open = () => {
    document.documentElement.classList.add("is-tried");
    document.getElementById("try").hidden = false;
    button.hidden = true;
    new TryIt(load(bica));
    if (isOnly) return;
    document.getElementById("drawing").scrollIntoView();
    document.querySelector(".try-bar button").focus({ preventScroll: true });
  };
  button.hidden = false;
  button.addEventListener("click", open);
  if (!isOnly) return;
  document.documentElement.classList.add("is-only-tried");
  document.head.append(el("base", { target: "_blank" }));
  open();
  new ResizeObserver(() => parent.postMessage({ vicodeTryHeight: document.body.offsetHeight }, "*")).observe(document.body);
};
