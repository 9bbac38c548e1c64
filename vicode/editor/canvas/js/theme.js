// Light or dark theme: from the scene, else from NiceGUI's body class, else from the system preference.

export class Theme {
  constructor(stage, onChange) {
    this.stage = stage;
    this.onChange = onChange;
    this.preference = "auto";
    this.colors = new Map();
    this.system = matchMedia("(prefers-color-scheme: dark)");
    this.refresh = () => this.#refresh();
    this.system.addEventListener("change", this.refresh);
    this.observer = new MutationObserver(this.refresh);
    this.observer.observe(document.body, { attributes: true, attributeFilter: ["class"] });
    this.#refresh();
  }

  set(preference) {
    this.preference = preference ?? "auto";
    this.#refresh();
  }

  /** Returns the value of a color of the style sheet, for bitmaps. */
  color(name) {
    if (!this.colors.has(name)) this.colors.set(name, getComputedStyle(this.stage).getPropertyValue(`--${name}`).trim());
    return this.colors.get(name);
  }

  dispose() {
    this.system.removeEventListener("change", this.refresh);
    this.observer.disconnect();
  }

  #refresh() {
    const theme = this.#resolve();
    if (theme === this.stage.dataset.theme) return;
    this.stage.dataset.theme = theme;
    this.colors.clear();
    this.onChange();
  }

  #resolve() {
    if (this.preference !== "auto") return this.preference;
    if (document.body.classList.contains("body--dark")) return "dark";
    if (document.body.classList.contains("body--light")) return "light";
    return this.system.matches ? "dark" : "light";
  }
}
