"""Keys that work wherever the focus is on a page."""

import json
from collections.abc import Sequence

from nicegui import ui

from vicode.editor.pages.form_input_preservation import preserve_form_input
from vicode.editor.panels.command import Command

ESCAPE_ATTRIBUTE = "data-escape-clicks"
"""The attribute of a button that Escape presses while it is seen, wherever the focus is."""

# Part of the page, so that no key comes too early for it. Text fields and the canvas undo in ways of their own.
_SHORTCUT_SCRIPT = """
<script>
// A dialog that was asked for by keys comes a moment later. Escape pressed meanwhile was meant for it.
let askedMs = -Infinity, isCalledOff = false;
const isPending = () => performance.now() - askedMs < 2000 && !document.querySelector(".q-dialog");
const callOff = (left) => {
  if (left > 0 && document.querySelector(".q-dialog")) {
    dispatchEvent(new KeyboardEvent("keydown", { key: "Escape", keyCode: 27, bubbles: true }));
    dispatchEvent(new KeyboardEvent("keyup", { key: "Escape", keyCode: 27, bubbles: true }));
    setTimeout(callOff, 50, left - 1);
  }
};
new MutationObserver(() => {
  if (!isCalledOff || !document.querySelector(".q-dialog")) return;
  if (performance.now() - askedMs < 2000) callOff(20);
  isCalledOff = false;
}).observe(document.body, { childList: true });
document.addEventListener("pointerdown", () => (isCalledOff = false), true);
document.addEventListener("keydown", (event) => {
  isCalledOff = event.key === "Escape" && isPending();
  const way = document.querySelector("[ESCAPE]");
  if (event.key === "Escape" && way?.offsetParent && !document.querySelector(".q-dialog, .q-menu")) {
    event.preventDefault();
    event.stopPropagation();
    way.click();
    return;
  }
  // Signs are named as they are printed, whatever must be held to reach them.
  const isSign = event.key.length === 1 && !/[\\p{L} ]/u.test(event.key);
  const held = [["Ctrl", event.ctrlKey || event.metaKey], ["Alt", event.altKey], ["Shift", event.shiftKey && !isSign]];
  const key = event.key.length === 1 ? event.key.toUpperCase() : event.key;
  const wish = (COMMANDS)[[...held.filter(([, is]) => is).map(([name]) => name), key].join("+")];
  const types = event.target.closest?.("input, textarea, [contenteditable=true], .canvas");
  // In the table a letter begins to type into the cell.
  const writes = event.key.length === 1 && !event.ctrlKey && !event.metaKey && !event.altKey;
  if (!wish || (types && !wish.typing) || (writes && event.target.closest?.(".vicode-table"))) return;
  event.preventDefault();
  askedMs = performance.now();
  // What can begin in the browser alone does so, and calls the event off.
  if (!dispatchEvent(new CustomEvent("vicode-command", { detail: wish.name, cancelable: true }))) return;
  // A page is seen a moment before it can speak to the server; what is asked then is asked a moment later.
  const ask = () => (window.did_handshake ? emitEvent("command-" + wish.name) : setTimeout(ask, 10));
  // A field tells what is typed after a pause; now it tells at once, at the end of this task, and then it is asked.
  if (event.target.matches?.("input, textarea")) event.target.dispatchEvent(new Event("change", { bubbles: true }));
  queueMicrotask(ask);
}, true);
// What is typed when the page is left or loaded again is told, too: the pause would be cut short.
addEventListener("beforeunload", () => {
  const field = document.activeElement;
  if (field?.matches("input, textarea")) field.dispatchEvent(new Event("change", { bubbles: true }));
});
</script>
"""


def register_shortcuts(commands: Sequence[Command]) -> None:
    """Do each command on its keys."""
    wishes = {}
    for command in commands:
        if command.on_canvas:
            continue
        for keys in command.keys:
            wishes[keys] = {"name": command.name, "typing": command.while_typing}
        if command.keys:
            ui.on(f"command-{command.name}", command.handler)
    preserve_form_input()
    ui.add_body_html(_SHORTCUT_SCRIPT.replace("COMMANDS", json.dumps(wishes)).replace("ESCAPE", ESCAPE_ATTRIBUTE))
