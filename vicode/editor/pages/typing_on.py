"""Nothing typed into a form is lost when the form is built anew, by whomever and at whatever moment.

A form is built anew when its thing is renamed, or its parts come and go. Until the browser has heard of it, people type
into fields that the server no longer has: what they say by themselves reaches nobody.

- Who is still in such a field when the new form comes goes on in the new one, with what was typed since.
- Who has left it by then tells what was typed, with the number of the field. The inspector knows the fields of forms
  before, and brings it to the field that took the place (`Inspector.hear_late`).
"""

from nicegui import ui

_KEEP = """
<script>
{
  let held = null;
  const nameOf = (field) => field.getAttribute("aria-label") ?? field.textContent;
  const alike = (panel, field) =>
    [...panel.querySelectorAll(field.tagName)].filter((each) => nameOf(each) === nameOf(field));
  const isText = (field) => field.matches("input:not([role], [type=checkbox]), textarea");
  const isTypedIn = (field) => isText(field) || field.isContentEditable || field.matches(".cm-content");
  const numberOf = (field) => Number((isText(field) ? field : field.closest("[id^=c]"))?.id?.slice(1));
  document.addEventListener("focusin", ({ target }) => {
    const panel = target.closest("[data-form]");
    if (target === held?.field) return;
    held = panel && target !== panel ? { field: target, form: panel.dataset.form } : null;
    if (held) held.at = alike(panel, target).indexOf(target);
  });
  const tell = ({ field, number, editor }) => {
    const text = editor ? editor.state.doc.toString() : isText(field) ? field.value : null;
    if (text !== null && number) emitEvent("typed-and-left", { number, text });
  };
  document.addEventListener("focusout", ({ target }) => {
    const was = held;
    // A browser tells of a field that is taken away as of one that is left. When it was, the new form has come by
    // the second microtask, and with it the one who typed; a field that is left is told before the next event.
    if (was?.isTyped && target === was.field)
      queueMicrotask(() => queueMicrotask(() => was.isCarriedOn || tell(was)));
    setTimeout(() => {
      if (held?.field.isConnected && document.activeElement === document.body) held = null;
    });
  });
  document.addEventListener("change", ({ target, isTrusted }) => {
    // A key that saves, or leads elsewhere, asks for what is typed without leaving the field.
    if (!isTrusted && held?.isTyped && target === held.field) tell(held);
  });
  document.addEventListener("input", ({ target }) => {
    if (target !== held?.field || held.isTyped) return;
    held.isTyped = true;
    held.number = numberOf(target);
    // It outlives the element, which may be gone when it is asked.
    if (!isText(target)) held.editor = getElement(held.number)?.editor;
  });
  const goOn = (panel, was) => {
    const { field, at, isTyped } = was;
    const next = alike(panel, field)[at];
    // A code editor comes a moment later.
    if (!next) return false;
    next.focus({ preventScroll: true });
    if (!isText(field) || !isText(next)) return true;
    was.isCarriedOn = true;
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


def keep_what_is_typed() -> None:
    """Add to the page what watches over its forms."""
    ui.add_body_html(_KEEP)
