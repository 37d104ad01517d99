// Finds the first half wall, body or soft part that a ray hits. Walls and bodies are tested in their body's frame. Soft
// parts move with two bodies and are tested in their present place.
import {conjugate, turned} from "./quaternion.js";

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** Computes the distance along the ray to a triangle, or Infinity (Moeller and Trumbore). */
function toTriangle(origin, way, a, b, c) {
  const u = minus(b, a), v = minus(c, a), p = cross(way, v), det = dot(u, p);
  if (Math.abs(det) < 1e-12) return Infinity;
  const t = minus(origin, a), x = dot(t, p) / det;
  if (x < 0 || x > 1) return Infinity;
  const q = cross(t, u), y = dot(way, q) / det;
  if (y < 0 || x + y > 1) return Infinity;
  const along = dot(v, q) / det;
  return along > 0 ? along : Infinity;
}

export class Picker {
  /** @param parts result of mesh() or solidsOf() */
  constructor({pieces, position, index, body}) {
    Object.assign(this, {pieces, position, index, body, ofBody: new Map(), soft: []});
    for (const piece of pieces) {
      if (piece.soft) this.soft.push(piece);
      else this.ofBody.set(piece.body, [...(this.ofBody.get(piece.body) ?? []), piece]);
    }
  }

  corner(n) {
    return [this.position[3 * n], this.position[3 * n + 1], this.position[3 * n + 2]];
  }

  /** Returns the present place of a corner, moved by its body. */
  carriedCorner(n, poses) {
    const at = 7 * this.body[n], arm = turned([...poses.subarray(at + 3, at + 7)], this.corner(n));
    return arm.map((v, k) => v + poses[at + k]);
  }

  /** Returns {body, hinge, local, distance} of the first hit in the frame of the poses, or null. `local` is relative
   *  to the body's vertex. */
  pick(origin, way, poses) {
    let best = null;
    const meet = (piece, o, w, corner, localOf) => {
      for (let k = piece.indices[0]; k < piece.indices[1]; k += 3) {
        const distance = toTriangle(o, w, ...[0, 1, 2].map((c) => corner(this.index[k + c])));
        if (distance < (best?.distance ?? Infinity)) best = {body: piece.body, hinge: piece.hinge, local: localOf(distance), distance};
      }
    };
    const along = (o, w, distance) => o.map((v, c) => v + distance * w[c]);
    const into = (body) => {
      const place = [...poses.subarray(7 * body, 7 * body + 3)], back = conjugate([...poses.subarray(7 * body + 3, 7 * body + 7)]);
      return {from: minus(origin, place), o: turned(back, minus(origin, place)), w: turned(back, way)};
    };
    for (const [body, pieces] of this.ofBody) {
      const {from, o, w} = into(body);
      if (Math.hypot(...cross(from, way)) > Math.max(...pieces.map(({reach}) => reach))) continue;
      for (const piece of pieces) meet(piece, o, w, (n) => this.corner(n), (distance) => along(o, w, distance));
    }
    for (const piece of this.soft) {
      const {o, w} = into(piece.body);
      meet(piece, origin, way, (n) => this.carriedCorner(n, poses), (distance) => along(o, w, distance));
    }
    return best;
  }
}
