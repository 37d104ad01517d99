// Best rigid placement of a shape onto the same shape elsewhere.
import {normalised, turned} from "./quaternion.js";

const SQUARINGS = 24;  // squarings of the matrix: the largest eigenvector remains, others shrink by their ratio to the power 2^24

/** Computes the rigid placement that maps a shape's poses to other poses of the same bodies: least squares over
 *  positions and axis directions.
 *  @param from, to 7 numbers per body   @param reach mm, weight of an axis as a length   @returns {turn, from, to}: p
 *  moves to turn(p - from) + to */
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

/** Computes Horn's quaternion from the sums of p q^T: the eigenvector of the largest eigenvalue, by squaring the
 *  matrix. */
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
