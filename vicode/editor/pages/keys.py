"""Keys that work wherever the focus is on a page."""

from collections.abc import Callable

from nicegui import ui

# The canvas and text fields undo in ways of their own.
_LISTEN = """
document.addEventListener("keydown", (event) => {
  if (!event.ctrlKey && !event.metaKey) return;
  const key = event.key.toLowerCase();
  const wish = { s: "save", y: "redo", z: event.shiftKey ? "redo" : "undo" }[key];
  const types = event.target.closest?.("input, textarea, [contenteditable=true], .canvas");
  if (!wish || (wish !== "save" && types)) return;
  event.preventDefault();
  emitEvent("key-" + wish);
}, true);
"""


def listen_to_keys(*, save: Callable[[], object], undo: Callable[[], object], redo: Callable[[], object]) -> None:
    """Call these on Ctrl+S, Ctrl+Z, and Ctrl+Shift+Z or Ctrl+Y (Cmd on a Mac)."""
    for name, act in (("save", save), ("undo", undo), ("redo", redo)):
        ui.on(f"key-{name}", act)
    ui.timer(0.05, lambda: ui.run_javascript(_LISTEN), once=True)
