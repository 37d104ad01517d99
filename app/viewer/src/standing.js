// Orientation in which people expect the object: a box on its base, an arch on its ends, a dome with its opening down,
// a panel flat.
import {turned} from "./quaternion.js";

const SAME_FACE = Math.cos(0.05);  // rad; panels within this angle are in one plane
const FACE_SHARE = 0.09;           // of all bodies: smallest flat part that can be a base
const LEAST_FACE = 6;              // bodies

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const scaled = (a, s) => a.map((v) => v * s);
const minus = (a, b) => a.map((v, k) => v - b[k]);
const mean = (points) => scaled(points.reduce((a, b) => a.map((v, k) => v + b[k]), [0, 0, 0]), 1 / points.length);

/** Returns direction `axis` of every body. */
function directions(poses, axis) {
  return Array.from({length: poses.length / 7}, (_, k) => turned(poses.subarray(7 * k + 3, 7 * k + 7), axis));
}
const places = (poses) => Array.from({length: poses.length / 7}, (_, k) => [...poses.subarray(7 * k, 7 * k + 3)]);

/** Returns whether the object would rest on a flat part without tipping: its centre must be above the part. */
function bears({normal, bodies}, points) {
  const base = mean(bodies.map((k) => points[k])), off = minus(mean(points), base), beside = minus(off, scaled(normal, dot(off, normal)));
  const far = Math.hypot(...beside);
  return far < 1e-6 || Math.max(...bodies.map((k) => dot(minus(points[k], base), beside))) >= far * far;
}

/** Returns the bodies of the largest flat part that can be a base; among nearly equal ones, of the one nearest to the
 *  middle of the sheet. */
function baseFace(normals, points, rest) {
  const groups = [], middle = mean(rest);
  normals.forEach((normal, k) => {
    const group = groups.find((each) => dot(each.normal, normal) > SAME_FACE);
    if (group) group.bodies.push(k);
    else groups.push({normal, bodies: [k]});
  });
  const off = ({bodies}) => Math.hypot(...minus(mean(bodies.map((k) => rest[k])), middle));
  const parts = groups.filter(({bodies}) => bodies.length >= Math.max(LEAST_FACE, FACE_SHARE * normals.length)).filter((part) => bears(part, points));
  if (!parts.length) return null;
  const most = Math.max(...parts.map(({bodies}) => bodies.length));
  const [best] = parts.filter(({bodies}) => bodies.length > 0.9 * most).sort((a, b) => off(a) - off(b));
  return best.bodies;
}

/** Returns the bodies that define the orientation, and whether their upper side must face down. */
export function standOf(poses, rest) {
  const normals = directions(poses, [0, 0, 1]), points = places(poses), face = baseFace(normals, points, rest);
  const bodies = face ?? normals.map((_, k) => k), up = mean(bodies.map((k) => normals[k]));
  const about = mean(points), base = mean(bodies.map((k) => points[k]));
  if (face) return {bodies, flipped: dot(minus(about, base), up) < -1e-6};
  const rise = points.reduce((sum, p, k) => sum + dot(minus(p, about), up) * (dot(normals[k], up) - dot(up, up)), 0);
  return {bodies, flipped: rise < 0};
}

/** Returns the rows of the rotation into the standing orientation: the turned x, across, up. */
export function standing({bodies, flipped}, poses) {
  const at = (axis) => mean(bodies.map((k) => turned(poses.subarray(7 * k + 3, 7 * k + 7), axis)));
  const sign = flipped ? -1 : 1;
  const up = normalised(scaled(at([0, 0, 1]), sign), [0, 0, sign]);
  const along = at([1, 0, 0]), level = minus(along, scaled(up, dot(along, up)));
  const x = normalised(level, Math.abs(up[0]) < 0.9 ? cross(cross(up, [1, 0, 0]), up) : cross(cross(up, [0, 1, 0]), up));
  return [x, cross(up, x), up];
}

function normalised(v, otherwise) {
  const size = Math.hypot(...v);
  return size > 1e-6 ? scaled(v, 1 / size) : scaled(otherwise, 1 / Math.hypot(...otherwise));
}
