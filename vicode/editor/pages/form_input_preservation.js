// Preserves input and clicks while the server rebuilds a form; see form_input_preservation.py.
{
  let focused = null;
  const accessibleName = (element) => element.getAttribute("aria-label") ?? element.textContent;
  const findSimilar = (panel, element) => [...panel.querySelectorAll(element.tagName)].filter((each) => accessibleName(each) === accessibleName(element));
  const elementId = (element) => Number(element.closest("[id^=c]")?.id.slice(1));
  const isText = (field) => field.matches("input:not([role], [type=checkbox]), textarea");
  const acceptsText = (field) => isText(field) || field.isContentEditable || field.matches(".cm-content");
  document.addEventListener("focusin", ({ target }) => {
    const panel = target.closest("[data-form]");
    if (target === focused?.field) return;
    focused = panel && target !== panel ? { field: target, form: panel.dataset.form } : null;
    if (focused) focused.at = findSimilar(panel, target).indexOf(target);
  });
  const sendDelayedInput = ({ field, number, editor }) => {
    const text = editor ? editor.state.doc.toString() : isText(field) ? field.value : null;
    if (text !== null && number) emitEvent("delayed-input", { number, text });
  };
  document.addEventListener("focusout", ({ target }) => {
    const was = focused;
    // A removed field also fires focusout. In that case, the new form is mounted and the input transferred by the
    // second microtask; otherwise the text is sent before the next event.
    if (was?.isTyped && target === was.field)
      queueMicrotask(() => queueMicrotask(() => was.isTransferred || sendDelayedInput(was)));
    setTimeout(() => {
      if (focused?.field.isConnected && document.activeElement === document.body) focused = null;
    });
  });
  document.addEventListener("change", ({ target, isTrusted }) => {
    // Shortcuts that save or navigate dispatch a change event while the field keeps the focus.
    if (!isTrusted && focused?.isTyped && target === focused.field) sendDelayedInput(focused);
  });
  document.addEventListener("input", ({ target }) => {
    if (target !== focused?.field || focused.isTyped) return;
    focused.isTyped = true;
    focused.number = elementId(target);
    // The editor outlives its element, which may be removed when the text is needed.
    if (!isText(target)) focused.editor = getElement(focused.number)?.editor;
  });
  const transferInput = (panel, was) => {
    const { field, at, isTyped } = was;
    const next = findSimilar(panel, field)[at];
    // Code editors are mounted later.
    if (!next) return false;
    next.focus({ preventScroll: true });
    if (!isText(field) || !isText(next)) return true;
    was.isTransferred = true;
    if (isTyped && next.value !== field.value) {
      emitEvent("input-transferred", { from: was.number, to: elementId(next) });
      next.value = field.value;
      next.dispatchEvent(new Event("input", { bubbles: true }));
    }
    next.setSelectionRange?.(field.selectionStart, field.selectionEnd);
    return true;
  };
  new MutationObserver(() => {
    if (!focused || focused.field.isConnected) return;
    const was = focused;
    focused = null;
    const panel = document.querySelector("[data-form]");
    if (!panel || ![document.body, panel].includes(document.activeElement)) return;
    const isSame = panel.dataset.form === was.form;
    if ((isSame && transferInput(panel, was)) || !acceptsText(was.field)) return;
    // Further keys must not run commands, even if the item no longer exists.
    panel.tabIndex = -1;
    panel.focus({ preventScroll: true });
    if (isSame) focused = was;
  }).observe(document.body, { childList: true, subtree: true });

  // The server ignores clicks on buttons of a replaced form. Each click is announced first, so that the server can detect
  // that the button no longer exists.
  const BUTTON = "button, [role=button], [role=checkbox], [role=switch]";
  const WAIT_MS = 1000;
  const MAX_REMEMBERED = 20;
  const CLICK_TOLERANCE_PX = 4;
  const presses = new Map();
  let pressed = null;
  const findPress = (target) => {
    const button = target.closest?.(BUTTON);
    const panel = button?.closest("[data-form]");
    return panel ? { button, at: findSimilar(panel, button).indexOf(button), where: null } : null;
  };
  const reportPress = (was) => {
    const number = elementId(was.button);
    presses.set(number, was);
    if (presses.size > MAX_REMEMBERED) presses.delete(presses.keys().next().value);
    emitEvent("button-pressed", number);
  };
  const repeat = (was) => {
    reportPress(was);
    was.button.click();
  };
  document.addEventListener(
    "pointerdown",
    ({ target, clientX, clientY }) => {
      pressed = findPress(target);
      if (pressed) pressed.where = { x: clientX, y: clientY };
    },
    true,
  );
  document.addEventListener("pointerup", ({ target, clientX, clientY }) => {
    // The button was replaced between pointerdown and pointerup, which browsers do not report as a click.
    const was = pressed;
    if (!was?.where || was.button.isConnected) return;
    pressed = null;
    const next = findPress(target);
    if (next && accessibleName(next.button) === accessibleName(was.button)) repeat(next);
    else if (Math.hypot(clientX - was.where.x, clientY - was.where.y) < CLICK_TOLERANCE_PX) retryPress(was, performance.now());
  });
  document.addEventListener(
    "click",
    ({ detail, isTrusted, target }) => {
      if (!isTrusted) return;
      // Keyboard clicks have no pointerdown.
      if (detail === 0) pressed = findPress(target);
      if (pressed?.button.contains(target)) reportPress(pressed);
    },
    true,
  );
  const retryPress = (was, sinceMs) => {
    const panel = document.querySelector("[data-form]");
    const next = panel && !was.button.isConnected && findSimilar(panel, was.button)[was.at];
    if (next) repeat({ button: next, at: was.at });
    else if (performance.now() - sinceMs < WAIT_MS) requestAnimationFrame(() => retryPress(was, sinceMs));
  };
  // Called by the server if the button no longer existed.
  window.repeatPress = (number) => presses.has(number) && retryPress(presses.get(number), performance.now());
}
