// Bodies of any shape as meshes, and the soft parts between them, whose halves move with the two bodies. Lengths in mm.

const CREASE = Math.cos(Math.PI / 6);  // between faces: sharper edges are drawn, others are rounded
const FAR = 1e6;                       // mm: no edge nearby

const minus = (a, b) => a.map((v, k) => v - b[k]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((v) => v / (Math.hypot(...a) || 1));

/** Decodes a mesh of the program (base64 of floats and integers) into {points: [[x, y, z]], triangles: [[a, b, c]]}. */
export function decoded({points, triangles}) {
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const threes = (numbers) => Array.from({length: numbers.length / 3}, (_, k) => [...numbers.subarray(3 * k, 3 * k + 3)]);
  return {points: threes(new Float32Array(bytes(points))), triangles: threes(new Uint32Array(bytes(triangles)))};
}

/** Computes for each triangle its normal, and for each of its edges whether it is sharp. */
function facesOf({points, triangles}) {
  const across = triangles.map(([a, b, c]) => cross(minus(points[b], points[a]), minus(points[c], points[a])));
  const normals = across.map(unit), beside = new Map();
  const key = (a, b) => (a < b ? a * points.length + b : b * points.length + a);
  const edges = ([a, b, c]) => [key(a, b), key(b, c), key(c, a)];
  triangles.forEach((triangle, n) => edges(triangle).forEach((edge) => beside.set(edge, [...(beside.get(edge) ?? []), n])));
  const sharp = triangles.map((triangle, n) => edges(triangle).map((edge) => beside.get(edge).every((m) => m === n || dot(normals[m], normals[n]) < CREASE)));
  return {across, normals, sharp};
}

/** Computes for each corner of each triangle the mean normal of the adjoining faces without a crease. */
function roundNormals({points, triangles}, {across, normals}) {
  const around = points.map(() => []);
  triangles.forEach((triangle, n) => triangle.forEach((p) => around[p].push(n)));
  return triangles.map((triangle, n) => triangle.map((p) => {
    const sum = [0, 0, 0];
    for (const m of around[p]) if (dot(normals[m], normals[n]) >= CREASE) across[m].forEach((v, k) => (sum[k] += v));
    return unit(sum);
  }));
}

/** Computes the distance of a triangle's corner from its edges; FAR for edges that are not sharp. */
function rimOf(corners, sharp, k) {
  const off = (a, b) => Math.hypot(...cross(minus(corners[k], a), unit(minus(b, a))));
  return [...[0, 1, 2].map((e) => (sharp[e] ? off(corners[e], corners[(e + 1) % 3]) : FAR)), FAR];
}

/** Returns the corners of the box around the points, relative to the body's position. */
function boxOf(points, place) {
  const ends = [Math.min, Math.max].map((pick) => [0, 1, 2].map((k) => points.reduce((v, p) => pick(v, p[k]), points[0][k]) - place[k]));
  return Array.from({length: 8}, (_, n) => [0, 1, 2].map((k) => ends[(n >> k) & 1][k]));
}

/** Makes one geometry for all meshes, with corners relative to the rest position of their body, and the bodies'
 *  boxes. Its pieces are {body} for a body and {body, hinge, soft} for a soft part.
 *  @param meshes {bodies: [mesh], hinges: [mesh or null]} */
export function solidsOf(structure, meshes) {
  const rest = structure.bodies.map(({position_mm}) => position_mm);
  const sources = [...meshes.bodies.map((mesh, body) => ({mesh, piece: {body}, bodyOf: () => body})),
    ...meshes.hinges.flatMap((mesh, hinge) => (mesh ? [softPart(structure.hinges[hinge], hinge, mesh)] : []))];
  const count = 3 * sources.reduce((sum, {mesh}) => sum + mesh.triangles.length, 0);
  const position = new Float32Array(3 * count), normal = new Float32Array(3 * count), rim = new Float32Array(4 * count), body = new Float32Array(count);
  let at = 0;
  const pieces = sources.map(({mesh, piece, bodyOf}) => {
    const faces = facesOf(mesh), normals = roundNormals(mesh, faces), from = at;
    mesh.triangles.forEach((triangle, n) => {
      const corners = triangle.map((p) => mesh.points[p]);
      corners.forEach((corner, k) => {
        body[at] = bodyOf(corner);
        position.set(minus(corner, rest[body[at]]), 3 * at);
        normal.set(normals[n][k], 3 * at);
        rim.set(rimOf(corners, faces.sharp[n], k), 4 * at);
        ++at;
      });
    });
    return {...piece, corners: [from, at], indices: [from, at], reach: piece.soft ? Infinity : Math.max(...mesh.points.map((p) => Math.hypot(...minus(p, rest[piece.body]))))};
  });
  const index = Uint32Array.from({length: count}, (_, k) => k);
  return {position, normal, body, rim, index, broad: index, pieces, boxes: meshes.bodies.map((mesh, k) => boxOf(mesh.points, rest[k]))};
}

/** Describes a soft part: points beyond its hinge move with the second body. */
function softPart({bodies: [lower, upper], point_mm, along}, hinge, mesh) {
  return {mesh, piece: {body: lower, hinge, soft: true}, bodyOf: (p) => (dot(along, minus(p, point_mm)) > 0 ? upper : lower)};
}
