/** Lines of equal value over a grid: marching squares. */

/** Which of a cell's sides (0 below, 1 right, 2 above, 3 left) a line joins, by which corners are above. */
const JOINS = [
  [], [[3, 0]], [[0, 1]], [[3, 1]], [[1, 2]], [[3, 0], [1, 2]], [[0, 2]], [[3, 2]],
  [[2, 3]], [[2, 0]], [[0, 1], [2, 3]], [[2, 1]], [[1, 3]], [[1, 0]], [[0, 3]], [],
];

/**
 * Return the pieces [x0, y0, x1, y1] of the line at a level, in places of the grid.
 * @param {(number|null)[][]} values by row and column @param {number} level
 */
export function contour(values, level) {
  const pieces = [];
  for (let row = 0; row + 1 < values.length; row += 1) {
    const [below, above] = [values[row], values[row + 1]];
    for (let column = 0; column + 1 < below.length; column += 1) {
      const a = below[column];
      const b = below[column + 1];
      const c = above[column + 1];
      const d = above[column];
      const which = (a >= level) | ((b >= level) << 1) | ((c >= level) << 2) | ((d >= level) << 3);
      if (which === 0 || which === 15 || a === null || b === null || c === null || d === null) continue;
      const corners = [a, b, c, d];
      for (const [from, to] of JOINS[which]) {
        pieces.push([...crossing(corners, from, level, column, row), ...crossing(corners, to, level, column, row)]);
      }
    }
  }
  return pieces;
}

/** Where a level crosses a side of a cell. */
function crossing(corners, side, level, column, row) {
  const [a, b] = [corners[side], corners[(side + 1) % 4]];
  const part = (level - a) / (b - a);
  return [
    [column + part, row],
    [column + 1, row + part],
    [column + 1 - part, row + 1],
    [column, row + 1 - part],
  ][side];
}

/** Return where a line's label stands, [x, y], far from the border and from other labels; null for no room. */
export function labelPlace(pieces, taken, { width, height }, room) {
  let best = null;
  let most = room;
  for (const [x0, y0, x1, y1] of pieces) {
    const [x, y] = [(x0 + x1) / 2, (y0 + y1) / 2];
    const border = Math.min(x, y * 1.6, width - x, (height - y) * 1.6) * 1.5;
    const nearest = taken.reduce((least, [a, b]) => Math.min(least, Math.hypot(a - x, b - y)), border);
    if (nearest > most) [best, most] = [[x, y], nearest];
  }
  return best;
}
