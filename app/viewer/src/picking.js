// Which half wall a ray meets first. Each plate is tested in its body's own frame, as a box cut along the hinge.
import {conjugate, turned} from "./quaternion.js";

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** Distance along the ray to a triangle, or Infinity (Moeller and Trumbore). */
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
  /** @param parts of mesh() */
  constructor(plates, {position, index, indices}) {
    Object.assign(this, {plates, position, index, indices, ofBody: new Map(), reach: new Map()});
    plates.forEach((plate, n) => {
      this.ofBody.set(plate.body, [...(this.ofBody.get(plate.body) ?? []), n]);
      const far = Math.max(...plate.corners.map((c) => Math.hypot(...c))) + Math.hypot(...plate.side);
      this.reach.set(plate.body, Math.max(far, this.reach.get(plate.body) ?? 0));
    });
  }

  corner(n) {
    return [this.position[3 * n], this.position[3 * n + 1], this.position[3 * n + 2]];
  }

  /** {body, hinge, local, distance} of what a ray meets in the frame of the poses, or null. `local` is from the body's vertex. */
  pick(origin, way, poses) {
    let best = null;
    for (const [body, plates] of this.ofBody) {
      const place = [...poses.subarray(7 * body, 7 * body + 3)], from = minus(origin, place);
      if (Math.hypot(...cross(from, way)) > this.reach.get(body)) continue;
      const back = conjugate([...poses.subarray(7 * body + 3, 7 * body + 7)]), o = turned(back, from), w = turned(back, way);
      for (const n of plates)
        for (let k = this.indices * n; k < this.indices * (n + 1); k += 3) {
          const distance = toTriangle(o, w, ...[0, 1, 2].map((c) => this.corner(this.index[k + c])));
          if (distance < (best?.distance ?? Infinity))
            best = {body, hinge: this.plates[n].hinge, local: o.map((v, c) => v + distance * w[c]), distance};
        }
    }
    return best;
  }
}
