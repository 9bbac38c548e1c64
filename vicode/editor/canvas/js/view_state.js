// The view of each page of the browser's history, so that Back shows a drawing as it was left.

export function saveView(component, { x, y, k }) {
  if (component) history.replaceState({ ...history.state, view: { component, x, y, k } }, "");
}

/** Shows the drawing as it was left on this page of the history; what is new here is fitted in. */
export function restoreView(canvas) {
  canvas.restoredView = recall(canvas.scene.component);
  if (!canvas.restoredView) return canvas.fit();
  canvas.fitPending = false;
  canvas.viewport.set(canvas.restoredView);
}

function recall(component) {
  const view = history.state?.view;
  return view?.component === component && [view.x, view.y, view.k].every(Number.isFinite) ? view : null;
}
