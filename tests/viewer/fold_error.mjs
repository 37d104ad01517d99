// How far the page's closed form is from the states of a result, relative to body 0.
import {conjugate, product, turned} from "../../app/viewer/src/quaternion.js";

const minus = (a, b) => a.map((v, k) => v - b[k]);

function relative(poses) {
  const {p, q} = poses[0], back = conjugate(q);
  return poses.map((pose) => ({p: turned(back, minus(pose.p, p)), q: product(back, pose.q)}));
}

/** The largest distance of places (over the size of the sheet) and of turns, of one state of result.json. */
export function foldError(state, numbers, structure) {
  const reported = relative(state.poses.map((pose) => ({p: pose.position_mm, q: pose.quaternion_wxyz})));
  const made = relative(reported.map((_, k) => ({p: [...numbers.slice(7 * k, 7 * k + 3)], q: [...numbers.slice(7 * k + 3, 7 * k + 7)]})));
  const size = Math.max(...structure.bodies.map(({position_mm}) => Math.hypot(...minus(position_mm, structure.bodies[0].position_mm))));
  let place = 0, turn = 0;
  reported.forEach((pose, k) => {
    place = Math.max(place, Math.hypot(...minus(pose.p, made[k].p)) / size);
    const sign = pose.q.reduce((sum, v, n) => sum + v * made[k].q[n], 0) < 0 ? -1 : 1;
    turn = Math.max(turn, Math.hypot(...pose.q.map((v, n) => v - sign * made[k].q[n])));
  });
  return {place, turn};
}
