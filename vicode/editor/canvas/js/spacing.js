// Where a dragged box has the same gap to its neighbours as others beside it have.

/**
 * Places along one axis where the gaps beside a rectangle would be equal.
 *
 * Only boxes in the same row (or column) count: those which the rectangle overlaps across the axis.
 * Args: the rectangle; all others; the axis, as `{name, size, across, length}`.
 * Returns: `{by, gaps}` each; how far to go, and the equal gaps as `[from, to]` along the axis.
 */
export function equalGaps(rect, rects, axis) {
  const { name, size } = axis;
  const mates = rects.filter((each) => overlapAcross(each, rect, axis)).map((each) => ({ from: each[name], to: each[name] + each[size] }));
  const middle = rect[name] + rect[size] / 2;
  const before = mates.filter((each) => (each.from + each.to) / 2 < middle).sort((a, b) => b.to - a.to);
  const after = mates.filter((each) => (each.from + each.to) / 2 > middle).sort((a, b) => a.from - b.from);
  return [between(rect, before[0], after[0], axis), behind(rect, before, axis), ahead(rect, after, axis)].filter((each) => each);
}

function between(rect, left, right, { name, size }) {
  const room = left && right ? right.from - left.to - rect[size] : 0;
  if (room <= 0) return null;
  const start = left.to + room / 2;
  return { by: start - rect[name], gaps: [[left.to, start], [start + rect[size], right.from]] };
}

function behind(rect, [near, ...others], { name }) {
  const next = near && others.find((each) => each.to < near.from);
  if (!next) return null;
  const start = near.to + near.from - next.to;
  return { by: start - rect[name], gaps: [[next.to, near.from], [near.to, start]] };
}

function ahead(rect, [near, ...others], { name, size }) {
  const next = near && others.find((each) => each.from > near.to);
  if (!next) return null;
  const end = near.from - (next.from - near.to);
  return { by: end - rect[name] - rect[size], gaps: [[end, near.from], [near.to, next.from]] };
}

const overlapAcross = (one, other, { across, length }) =>
  one[across] < other[across] + other[length] && other[across] < one[across] + one[length];
