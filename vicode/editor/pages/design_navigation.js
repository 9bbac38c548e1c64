// Opens designs without loading the page again: the server replaces the parts that show a design. The URL changes at once.
{
  const WAIT_MS = 3000;
  let shown = location.pathname + location.search;
  let keys = null;
  let untilMs = 0;
  const isDesign = (pathname) => pathname.startsWith("/design/");
  const focused = () => {
    let element = document.activeElement;
    while (element?.shadowRoot?.activeElement) element = element.shadowRoot.activeElement;
    return element;
  };

  const show = () => {
    shown = location.pathname + location.search;
    keys ??= [];
    untilMs = performance.now() + WAIT_MS;
    // Without a focused element, the canvas of the new design takes the focus.
    document.activeElement?.blur();
    emitEvent("show-design", shown);
  };

  /** Opens the design with this URL; called by links and by the server. */
  window.openDesign = (url) => {
    const { origin, pathname, search } = new URL(url, location);
    if (!window.did_handshake || origin !== location.origin || !isDesign(pathname)) return location.assign(url);
    dispatchEvent(new Event("vicode-leave"));
    history.pushState({}, "", pathname + search);
    show();
  };
  /** Changes the URL of the open design, unless another one was opened since. */
  window.replaceDesignUrl = (url) => {
    if (new URL(url, location).pathname !== location.pathname) return;
    history.replaceState(history.state, "", url);
    shown = location.pathname + location.search;
  };

  document.addEventListener("click", (event) => {
    const link = event.target.closest?.('a[href]:not([href^="#"])');
    const isPlain = !event.defaultPrevented && !event.button && !(event.ctrlKey || event.metaKey || event.shiftKey || event.altKey);
    if (!link || !isPlain || link.target || !isDesign(link.pathname ?? "")) return;
    event.preventDefault();
    window.openDesign(link.href);
  });
  addEventListener("popstate", () => {
    if (!isDesign(location.pathname)) return location.reload();
    // Not for another fragment of the same page.
    if (location.pathname + location.search === shown) return;
    dispatchEvent(new Event("vicode-leave"));
    show();
  });

  // Keys that are pressed before the new canvas exists would change the old design. The new canvas receives them.
  const stop = () => (keys = null);
  addEventListener(
    "keydown",
    (event) => {
      if (!keys || event.ctrlKey || event.altKey || event.metaKey) return;
      if (performance.now() > untilMs || document.activeElement !== document.body) return stop();
      keys.push(event);
      event.preventDefault();
      event.stopImmediatePropagation();
    },
    true,
  );
  addEventListener("pointerdown", stop, true);
  addEventListener("focusin", () => {
    const pressed = keys;
    stop();
    // The canvas takes the focus before it has its scene.
    if (pressed?.length) setTimeout(() => pressed.forEach(press));
  });
  const press = ({ key, code, shiftKey }) => {
    const target = focused();
    if (key.length === 1 && target.matches("input, textarea")) document.execCommand("insertText", false, key);
    else target.dispatchEvent(new KeyboardEvent("keydown", { key, code, shiftKey, bubbles: true, composed: true, cancelable: true }));
  };
}
