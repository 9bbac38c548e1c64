// A uniform grid over the plane: which keys may touch a rectangle, in constant time per cell.

const CELL = 320;
const NONE = new Set();

export class Grid {
  constructor() {
    this.cells = new Map();
    this.cellsByKey = new Map();
  }

  clear() {
    this.cells.clear();
    this.cellsByKey.clear();
  }

  /** Files a key under every cell its rectangle touches. */
  putRect(key, rect) {
    this.remove(key);
    this.#index(key, cellsOf(rect));
  }

  /** Files a key under the cells along a straight line, so that long diagonals stay cheap. */
  putLine(key, a, b) {
    this.putPath(key, [a, b]);
  }

  /** Files a key under the cells along a line through points. */
  putPath(key, points) {
    this.remove(key);
    const cells = new Set();
    for (let index = 1; index < points.length; index += 1) {
      const [a, b] = [points[index - 1], points[index]];
      const steps = Math.max(1, Math.ceil(Math.hypot(b.x - a.x, b.y - a.y) / (CELL / 2)));
      for (let step = 0; step <= steps; step += 1) cells.add(cellAt(a.x + ((b.x - a.x) * step) / steps, a.y + ((b.y - a.y) * step) / steps));
    }
    this.#index(key, [...cells]);
  }

  remove(key) {
    for (const cell of this.cellsByKey.get(key) ?? []) this.cells.get(cell)?.delete(key);
    this.cellsByKey.delete(key);
  }

  /** The keys of all cells that a rectangle touches; a superset of what really overlaps it. */
  query(rect) {
    const found = new Set();
    for (const cell of cellsOf(rect)) {
      for (const key of this.cells.get(cell) ?? []) found.add(key);
    }
    return found;
  }

  /** The keys of the one cell a point lies in, without copying them. */
  at(x, y) {
    return this.cells.get(cellAt(x, y)) ?? NONE;
  }

  #index(key, cells) {
    this.cellsByKey.set(key, cells);
    for (const cell of cells) {
      if (!this.cells.has(cell)) this.cells.set(cell, new Set());
      this.cells.get(cell).add(key);
    }
  }
}

// One number names a cell: 2^21 cells each way are far more than any design needs.
const cellName = (column, row) => (column + 1048576) * 2097152 + (row + 1048576);

const cellAt = (x, y) => cellName(Math.floor(x / CELL), Math.floor(y / CELL));

function cellsOf(rect) {
  const names = [];
  const right = Math.floor((rect.x + rect.w) / CELL);
  const bottom = Math.floor((rect.y + rect.h) / CELL);
  for (let column = Math.floor(rect.x / CELL); column <= right; column += 1) {
    for (let row = Math.floor(rect.y / CELL); row <= bottom; row += 1) names.push(cellName(column, row));
  }
  return names;
}
