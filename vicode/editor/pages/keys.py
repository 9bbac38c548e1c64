"""Keys that work wherever the focus is on a page."""

import json
from collections.abc import Sequence

from nicegui import ui

from vicode.editor.panels.command import Command

# Part of the page, so that no key comes too early for it. Text fields and the canvas undo in ways of their own.
_LISTEN = """
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
  // Signs are named as they are printed, whatever must be held to reach them.
  const isSign = event.key.length === 1 && !/[\\p{L} ]/u.test(event.key);
  const held = [["Ctrl", event.ctrlKey || event.metaKey], ["Alt", event.altKey], ["Shift", event.shiftKey && !isSign]];
  const key = event.key.length === 1 ? event.key.toUpperCase() : event.key;
  const wish = (WISHES)[[...held.filter(([, is]) => is).map(([name]) => name), key].join("+")];
  const types = event.target.closest?.("input, textarea, [contenteditable=true], .canvas");
  // In the table a letter begins to type into the cell.
  const writes = event.key.length === 1 && !event.ctrlKey && !event.metaKey && !event.altKey;
  if (!wish || (types && !wish.typing) || (writes && event.target.closest?.(".vicode-table"))) return;
  event.preventDefault();
  askedMs = performance.now();
  // What can begin in the browser alone does so, and calls the event off.
  if (!dispatchEvent(new CustomEvent("vicode-wish", { detail: wish.name, cancelable: true }))) return;
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


# A form is built anew when its thing is renamed or its parts come and go. Whoever is in a field of it, and what was
# typed there since the server heard of it, goes on in the new one; else the next letters would be taken for commands.
_KEEP_FOCUS = """
<script>
{
  let held = null;
  const nameOf = (field) => field.getAttribute("aria-label") ?? field.textContent;
  const alike = (panel, field) =>
    [...panel.querySelectorAll(field.tagName)].filter((each) => nameOf(each) === nameOf(field));
  const isText = (field) => field.matches("input:not([role], [type=checkbox]), textarea");
  const isTypedIn = (field) => isText(field) || field.isContentEditable || field.matches(".cm-content");
  document.addEventListener("focusin", ({ target }) => {
    const panel = target.closest("[data-form]");
    held = panel && target !== panel ? { field: target, form: panel.dataset.form } : null;
    if (held) held.at = alike(panel, target).indexOf(target);
  });
  document.addEventListener("focusout", () =>
    setTimeout(() => {
      if (held?.field.isConnected && document.activeElement === document.body) held = null;
    }),
  );
  document.addEventListener("input", ({ target }) => {
    if (target === held?.field) held.isTyped = true;
  });
  const goOn = (panel, { field, at, isTyped }) => {
    const next = alike(panel, field)[at];
    // A code editor comes a moment later.
    if (!next) return false;
    next.focus({ preventScroll: true });
    if (!isText(field) || !isText(next)) return true;
    if (isTyped && next.value !== field.value) {
      next.value = field.value;
      next.dispatchEvent(new Event("input", { bubbles: true }));
    }
    next.setSelectionRange?.(field.selectionStart, field.selectionEnd);
    return true;
  };
  new MutationObserver(() => {
    if (!held || held.field.isConnected) return;
    const was = held;
    held = null;
    const panel = document.querySelector("[data-form]");
    if (!panel || ![document.body, panel].includes(document.activeElement)) return;
    const isSame = panel.dataset.form === was.form;
    if ((isSame && goOn(panel, was)) || !isTypedIn(was.field)) return;
    // What is typed on is nobody's command, though the thing may be gone.
    panel.tabIndex = -1;
    panel.focus({ preventScroll: true });
    if (isSame) held = was;
  }).observe(document.body, { childList: true, subtree: true });
}
</script>
"""


def listen_to_keys(commands: Sequence[Command]) -> None:
    """Do each command on its keys."""
    wishes = {}
    for command in commands:
        if command.on_canvas:
            continue
        for keys in command.keys:
            wishes[keys] = {"name": command.name, "typing": command.while_typing}
        if command.keys:
            ui.on(f"command-{command.name}", command.act)
    ui.add_body_html(_KEEP_FOCUS)
    ui.add_body_html(_LISTEN.replace("WISHES", json.dumps(wishes)))
