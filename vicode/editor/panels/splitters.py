"""The splitters between diagram and panels, moved by mouse or arrow keys. The browser stores the sizes."""

from nicegui import ui

# Part of the page, so that the sizes are correct at the first paint.
_SPLITTER_SCRIPT = """
<script>
(() => {
  // A selector body:has(.dock) would compute the style of the whole page anew after each change of it.
  document.documentElement.classList.add("has-dock");
  const SPLITTERS = {
    side: {
      at: "clientX", least: 280, most: () => Math.min(1200, innerWidth - 480),
      usual: () => (innerWidth <= 1100 ? 312 : innerWidth < 2560 ? 368 : 448), keys: { ArrowLeft: 32, ArrowRight: -32 },
    },
    dock: {
      at: "clientY", least: 64, most: () => Math.min(640, innerHeight - 320),
      usual: () => (innerHeight <= 800 ? 104 : 152), keys: { ArrowUp: 24, ArrowDown: -24 },
    },
  };
  for (const [name, splitter] of Object.entries(SPLITTERS)) {
    const key = `vicode-${name}-size`;
    const most = () => Math.max(splitter.least, splitter.most());
    const clamp = (size) => Math.round(Math.max(splitter.least, Math.min(most(), size)));
    const readSize = () => { try { return Number(localStorage.getItem(key)) || 0; } catch { return 0; } };
    const storeSize = (size) => {
      try { localStorage.setItem(key, size); } catch { /* private windows have no storage */ }
    };
    const findSplitter = (event) => event.target.closest?.(`.${name}-splitter`);
    let size = 0;
    const show = (wanted) => {
      size = clamp(wanted);
      document.documentElement.style.setProperty(`--${name}`, size + "px");
      document.querySelector(`.${name}-splitter`)?.setAttribute("aria-valuenow", size);
    };
    show(readSize() || splitter.usual());
    document.addEventListener("pointerdown", (event) => {
      const held = findSplitter(event);
      if (!held || event.button !== 0) return;
      event.preventDefault();
      held.focus();
      held.setPointerCapture(event.pointerId);
      const from = event[splitter.at] + size;
      const move = (moved) => show(from - moved[splitter.at]);
      held.addEventListener("pointermove", move);
      held.addEventListener("lostpointercapture", () => {
        held.removeEventListener("pointermove", move);
        storeSize(size);
      }, { once: true });
    });
    // The splitter is created after this script: set its value when it gets the focus.
    document.addEventListener("focusin", (event) => findSplitter(event) && show(size));
    document.addEventListener("dblclick", (event) => {
      if (!findSplitter(event)) return;
      show(splitter.usual());
      storeSize(size);
    });
    document.addEventListener("keydown", (event) => {
      const step = { ...splitter.keys, Home: most(), End: -most() }[event.key];
      if (!findSplitter(event) || !step) return;
      event.preventDefault();
      show(size + step);
      storeSize(size);
    });
    addEventListener("resize", () => show(readSize() || splitter.usual()));
  }
})();
</script>
"""


def add_splitters() -> None:
    """Add the script of the splitters to the page; call once, before the panels are built."""
    ui.add_body_html(_SPLITTER_SCRIPT)


def side_splitter() -> None:
    splitter = _splitter("side", "vertical", "Width of the side panel")
    splitter.props('aria-valuemin="280" aria-valuemax="1200" aria-valuenow="368"')


def dock_splitter() -> None:
    splitter = _splitter("dock", "horizontal", "Height of the bottom panel")
    splitter.props('aria-valuemin="64" aria-valuemax="640" aria-valuenow="104"')


def _splitter(name: str, direction: str, label: str) -> ui.element:
    splitter = ui.element("div").classes(f"{name}-splitter")
    return splitter.props(f'role="separator" tabindex="0" aria-orientation="{direction}" aria-label="{label}"')
