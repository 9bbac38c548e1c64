// Stores the view in the browser's history, so that Back restores it.

// Until the next design is shown, the entry of the history belongs to that design already.
let isLeaving = false;
addEventListener("vicode-leave", () => (isLeaving = true));

export function saveView(component, { x, y, k }) {
  if (component && !isLeaving) history.replaceState({ ...history.state, view: { component, x, y, k } }, "");
}

/** Restores the view from the browser's history, or fits the scene if there is none. */
export function restoreView(canvas) {
  isLeaving = false;
  canvas.restoredView = recall(canvas.scene.component);
  if (!canvas.restoredView) return canvas.fit();
  canvas.fitPending = false;
  canvas.viewport.set(canvas.restoredView);
}

function recall(component) {
  const view = history.state?.view;
  return view?.component === component && [view.x, view.y, view.k].every(Number.isFinite) ? view : null;
}
