// Positions where a dragged node has the same gaps to its neighbors as other nodes in its row or column.

/**
 * Positions along one axis where the gaps next to a rectangle would be equal.
 *
 * Only nodes in the same row (or column) count: those that overlap the rectangle across the axis.
 * @param rects all other rectangles
 * @param axis `{name, size, across, length}`
 * @returns a list of `{offset, gaps}`: the distance to move, and the equal gaps as `[from, to]` along the axis
 */
export function equalGaps(rect, rects, axis) {
  const { name, size } = axis;
  const neighbors = rects.filter((other) => overlapAcross(other, rect, axis)).map((other) => ({ from: other[name], to: other[name] + other[size] }));
  const middle = rect[name] + rect[size] / 2;
  const before = neighbors.filter(({ from, to }) => (from + to) / 2 < middle).sort((a, b) => b.to - a.to);
  const after = neighbors.filter(({ from, to }) => (from + to) / 2 > middle).sort((a, b) => a.from - b.from);
  return [between(rect, before[0], after[0], axis), behind(rect, before, axis), ahead(rect, after, axis)].filter(Boolean);
}

function between(rect, left, right, { name, size }) {
  const room = left && right ? right.from - left.to - rect[size] : 0;
  if (room <= 0) return null;
  const start = left.to + room / 2;
  return { offset: start - rect[name], gaps: [[left.to, start], [start + rect[size], right.from]] };
}

function behind(rect, [near, ...others], { name }) {
  const next = near && others.find(({ to }) => to < near.from);
  if (!next) return null;
  const start = near.to + near.from - next.to;
  return { offset: start - rect[name], gaps: [[next.to, near.from], [near.to, start]] };
}

function ahead(rect, [near, ...others], { name, size }) {
  const next = near && others.find(({ from }) => from > near.to);
  if (!next) return null;
  const end = near.from - (next.from - near.to);
  return { offset: end - rect[name] - rect[size], gaps: [[end, near.from], [near.to, next.from]] };
}

const overlapAcross = (one, other, { across, length }) =>
  one[across] < other[across] + other[length] && other[across] < one[across] + one[length];
