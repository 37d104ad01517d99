// Outline of the opening of a cell between its walls, as in model/opening/cell_opening.hpp.
import {turned} from "./quaternion.js";

/** Moves a point of the flat sheet (mm) with a body. Without poses the point stays flat. */
function carried(structure, poses, body, point) {
  if (!poses) return point;
  const at = 7 * body, rest = structure.bodies[body].position_mm, arm = turned([...poses.slice(at + 3, at + 7)], point.map((v, c) => v - rest[c]));
  return arm.map((v, c) => poses[at + c] + v);
}

/** Returns three corners per body, in order: its vertex, the end of its wall, and the end on the next body, which
 *  differs if the hinge is stretched.
 *  @param poses 7 numbers per body (mm, w x y z), null for flat */
export function cellOutline(structure, {bodies, hinges}, poses) {
  return bodies.flatMap((body, k) => {
    const point = structure.hinges[hinges[k]].point_mm, next = bodies[(k + 1) % bodies.length];
    return [carried(structure, poses, body, structure.bodies[body].position_mm), carried(structure, poses, body, point), carried(structure, poses, next, point)];
  });
}

/** Computes the area of an outline seen from above, mm^2. */
export function areaWithin(points) {
  const n = points.length;
  return Math.abs(0.5 * points.reduce((sum, [x, y], k) => sum + x * points[(k + 1) % n][1] - y * points[(k + 1) % n][0], 0));
}
