// Walls as plates, carried by the poses of their bodies. Vectors are arrays, mm.

const add = (a, b) => a.map((v, k) => v + b[k]);
const subtract = (a, b) => a.map((v, k) => v - b[k]);
const scale = (a, s) => a.map((v) => v * s);
const dot = (a, b) => a.reduce((sum, v, k) => sum + v * b[k], 0);
const mix = (a, b, t) => a.map((v, k) => v + t * (b[k] - v));
const unit = (a) => scale(a, 1 / (Math.hypot(...a) || 1));

function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** Rotates v by the unit quaternion (w, x, y, z). */
function turned([w, x, y, z], v) {
  const u = [x, y, z];
  const t = scale(cross(u, v), 2);
  return add(add(v, scale(t, w)), cross(u, t));
}

function carried(pose, rest, point) {
  return add(pose.p, turned(pose.q, subtract(point, rest)));
}

/** Returns the point at which the two half walls of a hinge meet at rest. */
function wallTip(structure, hinge) {
  return hinge.offset ? mix(structure.bodies[hinge.a].rest, structure.bodies[hinge.b].rest, hinge.t) : hinge.point;
}

/** Returns the two half walls of a hinge at rest: one plate per body, cut along the hinge axis. */
function halfWalls(structure, hinge) {
  const from = structure.bodies[hinge.a].rest, to = structure.bodies[hinge.b].rest;
  const e = unit(subtract(to, from));
  const up = add([0, 0, Math.cos(hinge.beta)], scale(cross(e, [0, 0, 1]), Math.sin(hinge.beta)));
  const axis = hinge.axis ?? add(scale(e, Math.cos(hinge.alpha)), scale(up, Math.sin(hinge.alpha)));
  const rise = dot(axis, up);
  const cut = Math.abs(rise) < 0.05 ? up : scale(axis, 1 / rise);
  const half = structure.height / 2, tip = wallTip(structure, hinge);
  const plate = (body, corner) => ({
    body,
    hinge,
    corners: [
      add(corner, scale(up, -half)),
      add(tip, scale(cut, -half)),
      add(tip, scale(cut, half)),
      add(corner, scale(up, half)),
    ],
    side: scale(cross(e, up), structure.thickness / 2),
  });
  return [plate(hinge.a, from), plate(hinge.b, to)];
}

/** Returns the faces of imported bodies and of the halves of soft parts at rest, as plates without thickness. */
function solidFaces({hinges, meshes}) {
  const faces = (mesh, bodyOf) => mesh.triangles.map((triangle) => {
    const corners = triangle.map((p) => mesh.points[p]);
    return {mesh, corners, bodies: corners.map(bodyOf), side: [0, 0, 0]};
  });
  const half = ({a, b, point, across}) => (p) => (across && dot(across, subtract(p, point)) > 0 ? b : a);
  return [...meshes.bodies.flatMap((mesh, body) => faces(mesh, () => body)),
    ...meshes.hinges.flatMap((mesh, k) => (mesh ? faces(mesh, half(hinges[k])) : []))];
}

function plates(structure) {
  if (structure.isBodies) return (structure.faces ??= structure.meshes ? solidFaces(structure) : []);
  return structure.hinges.flatMap((hinge) => halfWalls(structure, hinge));
}

function carriedPlate(structure, state, plate) {
  const bodyOf = (k) => plate.bodies?.[k] ?? plate.body;
  return {
    ...plate,
    corners: plate.corners.map((corner, k) => carried(state.poses[bodyOf(k)], structure.bodies[bodyOf(k)].rest, corner)),
    side: turned(state.poses[bodyOf(0)].q, plate.side),
  };
}

/** Computes the convex hull of plane points, counter-clockwise (Andrew's monotone chain). */
function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const turn = (o, a, b) => (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  const chain = (sequence) => {
    const out = [];
    for (const p of sequence) {
      while (out.length > 1 && turn(out[out.length - 2], out[out.length - 1], p) <= 0) out.pop();
      out.push(p);
    }
    return out.slice(0, -1);
  };
  return [...chain(sorted), ...chain(sorted.reverse())];
}

/** Returns the outline of a plate with its thickness, projected by `project`. */
function outline(plate, project) {
  const solid = plate.corners.flatMap((corner) => [add(corner, plate.side), subtract(corner, plate.side)]);
  return hull(solid.map(project));
}

function extent(points) {
  const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  for (const p of points)
    for (const k of [0, 1]) {
      low[k] = Math.min(low[k], p[k]);
      high[k] = Math.max(high[k], p[k]);
    }
  return {low, high, size: subtract(high, low)};
}

function mean(points) {
  return scale(points.reduce(add), 1 / points.length);
}

/** Returns the mean position of the bodies in each column of vertices. */
function midline(structure, state) {
  const columns = new Map();
  structure.bodies.forEach((body, k) => {
    if (!columns.has(body.i)) columns.set(body.i, []);
    columns.get(body.i).push(state.poses[k].p);
  });
  return [...columns.entries()].sort((a, b) => a[0] - b[0]).map(([, points]) => mean(points));
}

/** Returns `count` points evenly spaced along a polyline. */
function resampled(line, count) {
  const at = [0];
  for (let k = 1; k < line.length; ++k) at.push(at[k - 1] + Math.hypot(...subtract(line[k], line[k - 1])));
  const total = at[at.length - 1];
  let k = 1;
  return Array.from({length: count}, (_, n) => {
    const s = (total * n) / (count - 1);
    while (k < line.length - 1 && at[k] < s) ++k;
    return mix(line[k - 1], line[k], (s - at[k - 1]) / (at[k] - at[k - 1] || 1));
  });
}

/** Computes the rotation and translation in the plane that best align `from` with `to`, point by point. */
function planeMotion(from, to) {
  const a = mean(from), b = mean(to);
  let real = 0, imaginary = 0;
  from.forEach((p, k) => {
    const u = subtract(p, a), v = subtract(to[k], b);
    real += dot(u, v);
    imaginary += u[0] * v[1] - u[1] * v[0];
  });
  const angle = Math.atan2(imaginary, real), c = Math.cos(angle), s = Math.sin(angle);
  const move = (p) => {
    const u = subtract(p, a);
    return [b[0] + c * u[0] - s * u[1], b[1] + s * u[0] + c * u[1]];
  };
  const misfit = Math.sqrt(mean(from.map((p, k) => [Math.hypot(...subtract(move(p), to[k])) ** 2]))[0]);
  return {move, misfit};
}

/** Returns a map from the structure's x, z to the frame of the target's drawing. Identity if that frame is unclear. */
function frameOfDrawing(goal, drawn) {
  const identity = (p) => p;
  if (goal.length < 2 || drawn.length < 2) return identity;
  const from = resampled(goal, 100), to = resampled(drawn, 100);
  const best =
      [planeMotion(from, to), planeMotion([...from].reverse(), to)].sort((a, b) => a.misfit - b.misfit)[0];
  return best.misfit < 0.02 * Math.hypot(...extent(to).size) ? best.move : identity;
}
