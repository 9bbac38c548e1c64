// Spatial index: a uniform grid that finds the keys near a rectangle in constant time per cell.

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

  /** Indexes a key under every cell that its rectangle touches. */
  putRect(key, rect) {
    this.remove(key);
    this.#index(key, cellsOf(rect));
  }

  /** Indexes a key under the cells along a straight line, which keeps long diagonals cheap. */
  putLine(key, a, b) {
    this.putPath(key, [a, b]);
  }

  /** Indexes a key under the cells along a polyline. */
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

  /** Returns the keys of all cells that a rectangle touches: a superset of the keys that overlap it. */
  query(rect) {
    const found = new Set();
    for (const cell of cellsOf(rect)) {
      for (const key of this.cells.get(cell) ?? []) found.add(key);
    }
    return found;
  }

  /** Returns the keys of the cell that contains a point, without copying them. */
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

// A cell is one number, which allows for 2^21 columns and rows.
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
