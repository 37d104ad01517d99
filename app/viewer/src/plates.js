// Walls as plates at rest: two half walls per hinge, each on one body. Lengths in mm.

const add = (a, b) => a.map((v, k) => v + b[k]);
const minus = (a, b) => a.map((v, k) => v - b[k]);
const scaled = (a, s) => a.map((v) => v * s);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const mix = (a, b, t) => a.map((v, k) => v + t * (b[k] - v));
const unit = (a) => scaled(a, 1 / (Math.hypot(...a) || 1));
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

const STEEPEST_CUT = 0.05;  // rise of the axis over its wall; below it the cut is upright
const OPENING = 0.03;       // of a cell edge, between the halves of a wall: makes the hinge visible

/** Returns thickness and height of walls. Old results have neither; they get defaults. */
export function wallSize(structure) {
  const {thickness, height} = structure.wall_mm ?? {};
  return {thickness: thickness ?? 0.08 * structure.cell_mm, height: height ?? 0.6 * structure.cell_mm};
}

/** Returns the half walls of one hinge: corners from the vertex's bottom round to its top, and half the thickness as
 *  a vector. */
function halfWalls(structure, hinge, index, size) {
  const rest = hinge.bodies.map((body) => structure.bodies[body].position_mm);
  const e = unit(minus(rest[1], rest[0])), z = [0, 0, 1];
  const up = add(scaled(z, Math.cos(hinge.beta_rad)), scaled(cross(e, z), Math.sin(hinge.beta_rad)));
  const rise = dot(hinge.axis, up);
  const cut = Math.abs(rise) < STEEPEST_CUT ? up : scaled(hinge.axis, 1 / rise);
  const tip = hinge.offset_mm ? mix(rest[0], rest[1], hinge.t) : hinge.point_mm, half = size.height / 2;
  const open = scaled(e, 0.5 * OPENING * structure.cell_mm);
  return [0, 1].map((end) => {
    const from = rest[end], to = end === 0 ? minus(tip, open) : add(tip, open);
    const corners = [[from, up, -half], [to, cut, -half], [to, cut, half], [from, up, half]];
    return {
      body: hinge.bodies[end],
      hinge: index,
      corners: corners.map(([point, way, by]) => minus(add(point, scaled(way, by)), from)),
      side: scaled(cross(e, up), size.thickness / 2),
    };
  });
}

/** Returns all half walls; corners are relative to the rest position of their body. */
export function platesOf(structure) {
  const size = wallSize(structure);
  return structure.hinges.flatMap((hinge, index) => halfWalls(structure, hinge, index, size));
}

// Broad faces come first. The face at the vertex is left out, since it is inside its neighbours.
const FACES = [[0, 1, 2, 3], [7, 6, 5, 4], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3]];
const CORNERS = 4 * FACES.length, INDICES = 6 * FACES.length, BROAD_INDICES = 6 * 2;

/** Computes the distances of a face's corners from its four sides. They are linear over the face, for drawing its
 *  boundary. */
function rims(corners) {
  const toSide = (p, a, b) => Math.hypot(...cross(minus(p, a), unit(minus(b, a))));
  return corners.map((p) => corners.map((a, k) => toSide(p, a, corners[(k + 1) % 4])));
}

/** Returns one buffer geometry of all plates: positions, normals, bodies, distances from sides and triangles (also of
 *  broad faces only). Outsides are counter-clockwise. */
export function mesh(plates) {
  const count = plates.length * CORNERS;
  const position = new Float32Array(3 * count), normal = new Float32Array(3 * count), rim = new Float32Array(4 * count);
  const body = new Float32Array(count), index = new Uint32Array(plates.length * INDICES);
  plates.forEach((plate, n) => {
    const solid = [...plate.corners.map((c) => add(c, plate.side)), ...plate.corners.map((c) => minus(c, plate.side))], middle = centre(solid);
    FACES.forEach((face, f) => {
      const corners = face.map((k) => solid[k]), at = CORNERS * n + 4 * f;
      const across = unit(cross(minus(corners[1], corners[0]), minus(corners[3], corners[0]))), inward = dot(across, minus(corners[0], middle)) < 0;
      const outward = inward ? scaled(across, -1) : across, far = rims(corners);
      corners.forEach((corner, k) => {
        position.set(corner, 3 * (at + k));
        normal.set(outward, 3 * (at + k));
        rim.set(far[k], 4 * (at + k));
      });
      body.fill(plate.body, at, at + 4);
      index.set((inward ? [0, 2, 1, 0, 3, 2] : [0, 1, 2, 0, 2, 3]).map((k) => at + k), INDICES * n + 6 * f);
    });
  });
  const broad = index.filter((_, k) => k % INDICES < BROAD_INDICES);
  return {position, normal, body, rim, index, broad, pieces: plates.map(pieceOf)};
}

/** Returns the owner of a range of corners and indices, and its reach from its body's position. */
function pieceOf({body, hinge, corners, side}, n) {
  const reach = Math.max(...corners.map((c) => Math.hypot(...c))) + Math.hypot(...side);
  return {body, hinge, corners: [CORNERS * n, CORNERS * (n + 1)], indices: [INDICES * n, INDICES * (n + 1)], reach};
}

function centre(points) {
  return scaled(points.reduce(add), 1 / points.length);
}
