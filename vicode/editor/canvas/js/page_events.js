// Tells the other parts of the page what the user selects and opens, before Python knows.

/** Returns false if one of them has handled it. */
export function announce(host, name, detail) {
  return host.dispatchEvent(new CustomEvent(name, { bubbles: true, cancelable: true, detail }));
}

/** Announces a gesture that opens a field. Returns the part of the report to Python that says whether the field is open already. */
export function announceOpening(host, kind, payload) {
  const isOpen = kind === "open" && !announce(host, "vicode-open", payload);
  const opensField = (kind === "use" && !payload.address) || (kind === "open" && payload.item.of !== "components");
  // Python opens the field; keys pressed before that belong to it. A page without such fields has no hook.
  if (opensField && !isOpen) window.awaitField?.();
  return isOpen ? { isOpen } : {};
}
