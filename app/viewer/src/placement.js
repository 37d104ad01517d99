// How a shape is laid onto the same shape elsewhere, as near as a rigid motion lets it.
import {normalised, turned} from "./quaternion.js";

const SQUARINGS = 24;  // of the matrix whose largest vector is the turn that fits: others shrink by their ratio to the power of 2^24

/**
 * The rigid placement that lays a shape's poses onto other poses of the same bodies: least squares over places and directions of axes.
 * @param from, to 7 numbers a body   @param reach mm, how long an axis counts as   @returns {turn, from, to}: p lies at turn(p - from) + to
 */
export function fitted(from, to, reach) {
  const count = from.length / 7, middle = (poses) => [0, 1, 2].map((k) => {
    let sum = 0;
    for (let at = k; at < poses.length; at += 7) sum += poses[at];
    return sum / count;
  });
  const a = middle(from), b = middle(to), sums = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];
  const add = (p, q) => p.forEach((v, i) => q.forEach((w, j) => (sums[i][j] += v * w)));
  for (let at = 0; at < from.length; at += 7) {
    add(a.map((v, k) => from[at + k] - v), b.map((v, k) => to[at + k] - v));
    const [q, r] = [from, to].map((poses) => [...poses.slice(at + 3, at + 7)]);
    for (const axis of [[reach, 0, 0], [0, reach, 0], [0, 0, reach]]) add(turned(q, axis), turned(r, axis));
  }
  return {turn: bestTurn(sums), from: a, to: b};
}

/** Horn's quaternion of the sums of p q^T: the vector of the largest eigenvalue, by squaring the matrix. */
function bestTurn([[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]]) {
  let m = [[xx + yy + zz, yz - zy, zx - xz, xy - yx], [yz - zy, xx - yy - zz, xy + yx, zx + xz], [zx - xz, xy + yx, yy - xx - zz, yz + zy], [xy - yx, zx + xz, yz + zy, zz - xx - yy]];
  const shift = Math.max(...m.map((row) => row.reduce((sum, v) => sum + Math.abs(v), 0))) || 1;  // makes all eigenvalues positive
  m = m.map((row, i) => row.map((v, j) => v / shift + (i === j ? 1 : 0)));
  for (let step = 0; step < SQUARINGS; ++step) {
    const size = m.reduce((sum, row, i) => sum + row[i], 0);
    m = m.map((row) => row.map((v) => v / size));
    m = m.map((row) => m[0].map((_, j) => row.reduce((sum, v, k) => sum + v * m[k][j], 0)));
  }
  return normalised(m.reduce((best, row) => (Math.hypot(...row) > Math.hypot(...best) ? row : best)));
}
