"""The grips beside the drawing: dragged, or moved by arrow keys; every browser keeps how large its panels are."""

from nicegui import ui

# Part of the page, so that the sizes are right before anything is drawn. The server need not know them.
_SPLITTER_SCRIPT = """
<script>
(() => {
  const GRIPS = {
    side: {
      at: "clientX", least: 280, most: () => Math.min(1200, innerWidth - 480),
      usual: () => (innerWidth <= 1100 ? 312 : innerWidth < 2560 ? 368 : 448), keys: { ArrowLeft: 32, ArrowRight: -32 },
    },
    dock: {
      at: "clientY", least: 64, most: () => Math.min(640, innerHeight - 320),
      usual: () => (innerHeight <= 800 ? 104 : 152), keys: { ArrowUp: 24, ArrowDown: -24 },
    },
  };
  for (const [name, grip] of Object.entries(GRIPS)) {
    const key = `vicode-${name}-size`;
    const most = () => Math.max(grip.least, grip.most());
    const clamp = (size) => Math.round(Math.max(grip.least, Math.min(most(), size)));
    const kept = () => { try { return Number(localStorage.getItem(key)) || 0; } catch { return 0; } };
    const keep = (size) => { try { localStorage.setItem(key, size); } catch { /* a private window keeps nothing */ } };
    const onGrip = (event) => event.target.closest?.(`.${name}-splitter`);
    let size = 0;
    const show = (wanted) => {
      size = clamp(wanted);
      document.documentElement.style.setProperty(`--${name}`, size + "px");
      document.querySelector(`.${name}-splitter`)?.setAttribute("aria-valuenow", size);
    };
    show(kept() || grip.usual());
    document.addEventListener("pointerdown", (event) => {
      const held = onGrip(event);
      if (!held || event.button !== 0) return;
      event.preventDefault();
      held.focus();
      held.setPointerCapture(event.pointerId);
      const from = event[grip.at] + size;
      const move = (moved) => show(from - moved[grip.at]);
      held.addEventListener("pointermove", move);
      held.addEventListener("lostpointercapture", () => {
        held.removeEventListener("pointermove", move);
        keep(size);
      }, { once: true });
    });
    // The grip comes later than this script: it says its size when it is reached.
    document.addEventListener("focusin", (event) => onGrip(event) && show(size));
    document.addEventListener("dblclick", (event) => { if (onGrip(event)) { show(grip.usual()); keep(size); } });
    document.addEventListener("keydown", (event) => {
      const step = { ...grip.keys, Home: most(), End: -most() }[event.key];
      if (!onGrip(event) || !step) return;
      event.preventDefault();
      show(size + step);
      keep(size);
    });
    addEventListener("resize", () => show(kept() || grip.usual()));
  }
})();
</script>
"""


def add_splitters() -> None:
    """Give the page the sizes that its browser keeps; once, before the panels."""
    ui.add_body_html(_SPLITTER_SCRIPT)


def side_splitter() -> None:
    """Build the grip at the left edge of the side panel."""
    grip = _splitter("side", "vertical", "Width of the side panel")
    grip.props('aria-valuemin="280" aria-valuemax="1200" aria-valuenow="368"')


def dock_splitter() -> None:
    """Build the grip at the upper edge of the dock."""
    grip = _splitter("dock", "horizontal", "Height of the panels below")
    grip.props('aria-valuemin="64" aria-valuemax="640" aria-valuenow="104"')


def _splitter(name: str, direction: str, label: str) -> ui.element:
    grip = ui.element("div").classes(f"{name}-splitter")
    return grip.props(f'role="separator" tabindex="0" aria-orientation="{direction}" aria-label="{label}"')
