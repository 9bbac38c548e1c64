"""Keys that work wherever the focus is on a page."""

from collections.abc import Callable

from nicegui import ui

# The canvas and text fields undo in ways of their own. Part of the page, so that no key comes too early for it.
_LISTEN = """
<script>
document.addEventListener("keydown", (event) => {
  if (!event.ctrlKey && !event.metaKey) return;
  const key = event.key.toLowerCase();
  const wish = { s: "save", y: "redo", z: event.shiftKey ? "redo" : "undo" }[key];
  const types = event.target.closest?.("input, textarea, [contenteditable=true], .canvas");
  if (!wish || (wish !== "save" && types)) return;
  event.preventDefault();
  if (window.did_handshake) emitEvent("key-" + wish);
}, true);
</script>
"""


def listen_to_keys(*, save: Callable[[], object], undo: Callable[[], object], redo: Callable[[], object]) -> None:
    """Call these on Ctrl+S, Ctrl+Z, and Ctrl+Shift+Z or Ctrl+Y (Cmd on a Mac)."""
    for name, act in (("save", save), ("undo", undo), ("redo", redo)):
        ui.on(f"key-{name}", act)
    ui.add_body_html(_LISTEN)
