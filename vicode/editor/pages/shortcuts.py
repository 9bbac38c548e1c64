"""Keyboard shortcuts of a page, independent of the focus."""

import inspect
import json
from collections.abc import Callable, Coroutine, Sequence
from pathlib import Path

from nicegui import ui
from nicegui.events import GenericEventArguments

from vicode.editor.panels.commands.command import Command, CommandHandler
from vicode.editor.session.gestures.delivery import Inbox

ESCAPE_ATTRIBUTE = "data-escape-clicks"
"""Attribute of a button that Escape clicks while the button is visible, independent of the focus."""

_TYPE_AHEAD = Path(__file__).with_name("type_ahead.js")

# Part of the page, so that it handles keys from the start. Text fields and the canvas have their own undo.
_SHORTCUT_SCRIPT = """
<script>
// A dialog opened by a key appears with a delay. Escape pressed before that closes it when it appears.
let pendingCommands = 0, isCancelled = false;
const isPending = () => pendingCommands > 0 && !document.querySelector(".q-dialog");
const endCommand = () => {
  pendingCommands = Math.max(pendingCommands - 1, 0);
  isCancelled &&= pendingCommands > 0;
};
// The server reports the end of a command; a dialog that it opened is drawn within two frames.
addEventListener("vicode-command-end", () => requestAnimationFrame(() => requestAnimationFrame(endCommand)));
const cancelDialog = (left) => {
  if (left > 0 && document.querySelector(".q-dialog")) {
    dispatchEvent(new KeyboardEvent("keydown", { key: "Escape", keyCode: 27, bubbles: true }));
    dispatchEvent(new KeyboardEvent("keyup", { key: "Escape", keyCode: 27, bubbles: true }));
    setTimeout(cancelDialog, 50, left - 1);
  }
};
new MutationObserver(() => {
  if (!isCancelled || !document.querySelector(".q-dialog")) return;
  cancelDialog(100);
  isCancelled = false;
}).observe(document.body, { childList: true });
document.addEventListener("pointerdown", () => (isCancelled = false), true);
document.addEventListener("keydown", (event) => {
  isCancelled = event.key === "Escape" && isPending();
  const button = document.querySelector("[ESCAPE]");
  if (event.key === "Escape" && button?.offsetParent && !document.querySelector(".q-dialog, .q-menu")) {
    event.preventDefault();
    event.stopPropagation();
    button.click();
    return;
  }
  // Punctuation keys are named by the printed character; Shift is not part of the name.
  const isSign = event.key.length === 1 && !/[\\p{L} ]/u.test(event.key);
  const held = [["Ctrl", event.ctrlKey || event.metaKey], ["Alt", event.altKey], ["Shift", event.shiftKey && !isSign]];
  const key = event.key.length === 1 ? event.key.toUpperCase() : event.key;
  const command = (COMMANDS)[[...held.filter(([, is]) => is).map(([name]) => name), key].join("+")];
  const types = event.target.closest?.("input, textarea, [contenteditable=true], .canvas");
  // In the table, a letter starts editing the cell.
  const writes = event.key.length === 1 && !event.ctrlKey && !event.metaKey && !event.altKey;
  if (!command || (types && !command.typing) || (writes && event.target.closest?.(".vicode-table"))) return;
  event.preventDefault();
  // A command that the browser can start alone cancels the event.
  if (!dispatchEvent(new CustomEvent("vicode-command", { detail: command.name, cancelable: true }))) return;
  pendingCommands += 1;
  const send = () => window.deliver((fields) => emitEvent("command-" + command.name, fields), {});
  // Fields send typed text after a pause. Send it now, before the command.
  dispatchEvent(new Event("vicode-send-text"));
  queueMicrotask(send);
}, true);
// Send typed text before a command, and before the page shows another design or unloads: the pause would be cut short.
const sendText = () => {
  const field = document.activeElement;
  if (field?.matches("input, textarea")) field.dispatchEvent(new Event("change", { bubbles: true }));
};
for (const event of ["vicode-send-text", "vicode-leave", "beforeunload"]) addEventListener(event, sendText);
</script>
"""


def register_shortcuts(commands: Sequence[Command], inbox: Inbox) -> None:
    """Run each command when one of its keys is pressed."""
    shortcuts = {}
    for command in commands:
        if command.on_canvas:
            continue
        for keys in command.keys:
            shortcuts[keys] = {"name": command.name, "typing": command.while_typing}
        if command.keys:
            ui.on(f"command-{command.name}", _reporting_end(command.handler, inbox))
    ui.add_body_html(f"<script>\n{_TYPE_AHEAD.read_text(encoding='utf-8')}</script>")
    ui.add_body_html(_SHORTCUT_SCRIPT.replace("COMMANDS", json.dumps(shortcuts)).replace("ESCAPE", ESCAPE_ATTRIBUTE))


def _reporting_end(handler: CommandHandler, inbox: Inbox) -> Callable[[GenericEventArguments], object]:
    def handle(event: GenericEventArguments) -> object:
        if not inbox.take(event.args):
            return None
        result = handler()
        if inspect.iscoroutine(result):
            return _finish(result)
        _report_end()
        return None

    return handle


async def _finish(running: Coroutine[object, object, object]) -> None:
    try:
        await running
    finally:
        _report_end()


def _report_end() -> None:
    ui.run_javascript('dispatchEvent(new Event("vicode-command-end"))')
