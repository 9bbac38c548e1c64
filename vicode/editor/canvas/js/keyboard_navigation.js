// From thing to thing without a pointer: in the order of the design, or in a direction. Pure functions.

/** Every node, each followed by what leaves it: transitions by their order, then links. */
export function tabOrder(scene) {
  return [...scene.nodes.values()].flatMap((node) => {
    const leaving = scene.edgesOf(node.key).filter((edge) => edge.source === node.key && scene.isDrawable(edge));
    leaving.sort((a, b) => (a.data.order ?? Infinity) - (b.data.order ?? Infinity) || 0);
    return [node.key, ...leaving.map((edge) => edge.key)];
  });
}

/** The nearest box in a direction; what lies aside counts as farther away. */
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
