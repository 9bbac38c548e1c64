// A form that the server builds anew, at whatever moment: what was typed or pressed in the one before is not lost.
{
  let held = null;
  const nameOf = (element) => element.getAttribute("aria-label") ?? element.textContent;
  const alike = (panel, element) => [...panel.querySelectorAll(element.tagName)].filter((each) => nameOf(each) === nameOf(element));
  const numberOf = (element) => Number(element.closest("[id^=c]")?.id.slice(1));
  const isText = (field) => field.matches("input:not([role], [type=checkbox]), textarea");
  const isTypedIn = (field) => isText(field) || field.isContentEditable || field.matches(".cm-content");
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
      emitEvent("carried-on", { from: was.number, to: numberOf(next) });
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

  // A press on a button of a form that the server has built anew since reaches nobody. It is told beside the click, and
  // before it: whoever hears it knows whether the button was still there.
  const BUTTON = "button, [role=button], [role=checkbox], [role=switch]";
  const WAIT_MS = 1000;
  const MOST_REMEMBERED = 20;
  const STILL_PX = 4;
  const presses = new Map();
  let pressed = null;
  const press = (target) => {
    const button = target.closest?.(BUTTON);
    const panel = button?.closest("[data-form]");
    return panel ? { button, at: alike(panel, button).indexOf(button), where: null } : null;
  };
  const tellPress = (was) => {
    const number = numberOf(was.button);
    presses.set(number, was);
    if (presses.size > MOST_REMEMBERED) presses.delete(presses.keys().next().value);
    emitEvent("pressed", number);
  };
  const repeat = (was) => {
    tellPress(was);
    was.button.click();
  };
  document.addEventListener(
    "pointerdown",
    ({ target, clientX, clientY }) => {
      pressed = press(target);
      if (pressed) pressed.where = { x: clientX, y: clientY };
    },
    true,
  );
  document.addEventListener("pointerup", ({ target, clientX, clientY }) => {
    // Replaced under the hand, which lets go above the new one, or where the old one was: for browsers that is no click.
    const was = pressed;
    if (!was?.where || was.button.isConnected) return;
    pressed = null;
    const next = press(target);
    if (next && nameOf(next.button) === nameOf(was.button)) repeat(next);
    else if (Math.hypot(clientX - was.where.x, clientY - was.where.y) < STILL_PX) again(was, performance.now());
  });
  document.addEventListener(
    "click",
    ({ detail, isTrusted, target }) => {
      if (!isTrusted) return;
      // A key clicks as well.
      if (detail === 0) pressed = press(target);
      if (pressed?.button.contains(target)) tellPress(pressed);
    },
    true,
  );
  const again = (was, sinceMs) => {
    const panel = document.querySelector("[data-form]");
    const next = panel && !was.button.isConnected && alike(panel, was.button)[was.at];
    if (next) repeat({ button: next, at: was.at });
    else if (performance.now() - sinceMs < WAIT_MS) requestAnimationFrame(() => again(was, sinceMs));
  };
  // The answer, when it was not there any more.
  window.pressAgain = (number) => presses.has(number) && again(presses.get(number), performance.now());
}
