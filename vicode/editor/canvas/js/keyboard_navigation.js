// Keyboard navigation between elements, in the order of the design or in a direction. Pure functions.

/** Returns the keys of all nodes, each followed by its outgoing edges: transitions by priority, then links; last the frames. */
export function tabOrder(scene) {
  const nodes = scene.shownNodes().flatMap((node) => {
    const leaving = scene.edgesOf(node.key).filter((edge) => edge.source === node.key && scene.isDrawable(edge));
    leaving.sort((a, b) => (a.data.order ?? Infinity) - (b.data.order ?? Infinity) || 0);
    return [node.key, ...leaving.map((edge) => edge.key)];
  });
  return [...nodes, ...scene.shownFrames().map(({ key }) => key)];
}

/** Returns the nearest node in a direction; distance across the direction counts twice. */
export function nearestInDirection(boxes, from, [dx, dy]) {
  let best = null;
  for (const box of boxes) {
    const ahead = (box.x - from.x) * dx + (box.y - from.y) * dy;
    const aside = Math.abs((box.x - from.x) * dy) + Math.abs((box.y - from.y) * dx);
    const cost = ahead + 2 * aside;
    if (ahead > 1 && (!best || cost < best.cost)) best = { box, cost };
  }
  return best?.box ?? null;
}
