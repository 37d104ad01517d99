// Unit quaternions (w, x, y, z) and vectors as plain arrays; lengths in mm, angles in rad.

export function turnAbout([x, y, z], angle) {
  const s = Math.sin(angle / 2);
  return [Math.cos(angle / 2), s * x, s * y, s * z];
}

/** Multiplies two rotations: first b, then a. */
export function product([aw, ax, ay, az], [bw, bx, by, bz]) {
  return [
    aw * bw - ax * bx - ay * by - az * bz,
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
  ];
}

/** Computes the angle between two bodies, rad. @param poses 7 numbers per body (mm, w x y z) */
export function turnBetween(poses, a, b) {
  const dot = [3, 4, 5, 6].reduce((sum, k) => sum + poses[7 * a + k] * poses[7 * b + k], 0);
  return 2 * Math.acos(Math.min(1, Math.abs(dot)));
}

export function conjugate([w, x, y, z]) {
  return [w, -x, -y, -z];
}

/** Rotates v by q. */
export function turned([w, x, y, z], [a, b, c]) {
  const tx = 2 * (y * c - z * b), ty = 2 * (z * a - x * c), tz = 2 * (x * b - y * a);
  return [a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx];
}

export function normalised(q) {
  const size = Math.hypot(...q) || 1;
  return q.map((v) => v / size);
}

/** Interpolates between two orientations along the shorter path, t in [0, 1]. */
export function slerp(a, b, t) {
  let cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const sign = cosine < 0 ? -1 : 1;
  cosine *= sign;
  const angle = Math.acos(Math.min(1, cosine)), s = Math.sin(angle);
  const [u, v] = s < 1e-9 ? [1 - t, t] : [Math.sin((1 - t) * angle) / s, Math.sin(t * angle) / s];
  return normalised(a.map((value, k) => u * value + sign * v * b[k]));
}
