// Interpolated poses, for shapes without a closed form.
import {slerp} from "./quaternion.js";

/** @param frames [{theta, poses (7 numbers per body)}], theta increasing   @returns a function of theta, clamped to
 *  the frames */
export function storedMotion(frames) {
  return (theta, out = new Float64Array(frames[0].poses.length)) => {
    const after = frames.findIndex((frame) => frame.theta >= theta);
    if (after <= 0) return out.set(frames[after < 0 ? frames.length - 1 : 0].poses), out;
    const a = frames[after - 1], b = frames[after], t = (theta - a.theta) / (b.theta - a.theta || 1);
    for (let k = 0; k < out.length; k += 7) {
      for (let n = 0; n < 3; ++n) out[k + n] = a.poses[k + n] + t * (b.poses[k + n] - a.poses[k + n]);
      out.set(slerp([...a.poses.subarray(k + 3, k + 7)], [...b.poses.subarray(k + 3, k + 7)], t), k + 3);
    }
    return out;
  };
}
