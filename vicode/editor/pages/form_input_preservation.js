// Preserves clicks and the focus while the server replaces parts of a form; see form_input_preservation.py.
{
  const findPanel = () => document.querySelector("[data-form]");
  let focused = null;
  document.addEventListener("focusin", ({ target }) => {
    focused = target.closest("[data-form]") ? target : null;
  });
  const isText = (field) => field.matches("input:not([role], [type=checkbox]), textarea, .cm-content") || field.isContentEditable;
  new MutationObserver((records) => {
    const nodes = focused && document.activeElement === document.body ? records.flatMap(({ removedNodes }) => [...removedNodes]) : [];
    if (!nodes.some((node) => node.contains(focused))) return;
    if (focused.isConnected) {
      // Moving an element takes the focus away.
      focused.focus({ preventScroll: true });
      return;
    }
    const panel = findPanel();
    if (!panel || !isText(focused)) return;
    // Further keys must not run commands.
    panel.tabIndex = -1;
    panel.focus({ preventScroll: true });
  }).observe(document.body, { childList: true, subtree: true });

  // The server ignores clicks on buttons of a removed form. Each click is announced first, so that the server can detect
  // that the button no longer exists.
  const BUTTON = "button, [role=button], [role=checkbox], [role=switch]";
  const WAIT_MS = 1000;
  const MAX_REMEMBERED = 20;
  const CLICK_TOLERANCE_PX = 4;
  const accessibleName = (element) => element.getAttribute("aria-label") ?? element.textContent;
  const findSimilar = (panel, element) => [...panel.querySelectorAll(element.tagName)].filter((each) => accessibleName(each) === accessibleName(element));
  const presses = new Map();
  let pressed = null;
  const findPress = (target) => {
    const button = target.closest?.(BUTTON);
    const panel = button?.closest("[data-form]");
    return panel ? { button, at: findSimilar(panel, button).indexOf(button), where: null } : null;
  };
  const reportPress = (was) => {
    const number = Number(was.button.closest("[id^=c]")?.id.slice(1));
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
    // The button was replaced or moved between pointerdown and pointerup, which browsers do not report as a click.
    const was = pressed;
    if (!was?.where || was.button.contains(target)) return;
    pressed = null;
    const next = was.button.isConnected ? null : findPress(target);
    if (next && accessibleName(next.button) === accessibleName(was.button)) repeat(next);
    else if (Math.hypot(clientX - was.where.x, clientY - was.where.y) >= CLICK_TOLERANCE_PX) return;
    else if (was.button.isConnected) repeat(was);
    else retryPress(was, performance.now());
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
    const panel = findPanel();
    const next = panel && !was.button.isConnected && findSimilar(panel, was.button)[was.at];
    if (next) repeat({ button: next, at: was.at });
    else if (performance.now() - sinceMs < WAIT_MS) requestAnimationFrame(() => retryPress(was, sinceMs));
  };
  // Called by the server if the button no longer existed.
  window.repeatPress = (number) => presses.has(number) && retryPress(presses.get(number), performance.now());
}
