// Stores the view in the browser's history, so that Back restores it.

// Until the designs that were opened are shown, the entry of the history belongs to the last of them already.
let awaited = 0;
addEventListener("vicode-leave", () => (awaited += 1));

export function saveView(component, { x, y, k }) {
  if (component && !awaited) history.replaceState({ ...history.state, view: { component, x, y, k } }, "");
}

/** Restores the view from the browser's history, or fits the scene if there is none. */
export function restoreView(canvas) {
  awaited = Math.max(0, awaited - 1);
  canvas.restoredView = recall(canvas.scene.component);
  if (!canvas.restoredView) return canvas.fit();
  canvas.fitPending = false;
  canvas.viewport.set(canvas.restoredView);
}

function recall(component) {
  const view = history.state?.view;
  return view?.component === component && [view.x, view.y, view.k].every(Number.isFinite) ? view : null;
}
