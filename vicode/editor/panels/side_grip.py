"""The grip between the drawing and the side panel: dragged, or moved by arrow keys; every browser keeps its width."""

from nicegui import ui

# Part of the page, so that the width is right before anything is drawn. The server need not know it.
_GRIP = """
<script>
(() => {
  const KEY = "vicode-side-width", LEAST = 280;
  const most = () => Math.max(LEAST, Math.min(1200, innerWidth - 480));
  const usual = () => (innerWidth <= 1100 ? 312 : 368);
  const clamp = (width) => Math.round(Math.max(LEAST, Math.min(most(), width)));
  const kept = () => { try { return Number(localStorage.getItem(KEY)) || 0; } catch { return 0; } };
  const keep = (width) => { try { localStorage.setItem(KEY, width); } catch { /* a private window keeps nothing */ } };
  let width = kept() ? clamp(kept()) : usual();
  function show(wanted) {
    width = clamp(wanted);
    document.documentElement.style.setProperty("--side", width + "px");
    document.querySelector(".side-grip")?.setAttribute("aria-valuenow", width);
  }
  show(width);
  const onGrip = (event) => event.target.closest?.(".side-grip");
  document.addEventListener("pointerdown", (event) => {
    const grip = onGrip(event);
    if (!grip || event.button !== 0) return;
    event.preventDefault();
    grip.focus();
    grip.setPointerCapture(event.pointerId);
    const from = event.clientX + width;
    const move = (moved) => show(from - moved.clientX);
    grip.addEventListener("pointermove", move);
    grip.addEventListener("lostpointercapture", () => {
      grip.removeEventListener("pointermove", move);
      keep(width);
    }, { once: true });
  });
  // The grip comes later than this script: it says its width when it is reached.
  document.addEventListener("focusin", (event) => onGrip(event) && show(width));
  document.addEventListener("dblclick", (event) => { if (onGrip(event)) { show(usual()); keep(width); } });
  document.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: 32, ArrowRight: -32, Home: most(), End: -most() }[event.key];
    if (!onGrip(event) || !step) return;
    event.preventDefault();
    show(width + step);
    keep(width);
  });
  addEventListener("resize", () => show(kept() || usual()));
})();
</script>
"""


def side_grip() -> None:
    """Build the grip at the left edge of the side panel."""
    ui.add_body_html(_GRIP)
    grip = ui.element("div").classes("side-grip")
    grip.props('role="separator" tabindex="0" aria-orientation="vertical" aria-label="Width of the side panel"')
    grip.props('aria-valuemin="280" aria-valuemax="1200" aria-valuenow="368"')
