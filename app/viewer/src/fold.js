// Closed form of exact sheets, for all lattices (kinematics.md section 2). Every hinge turns its upper body against its
// lower one about its axis. A tree of hinges leads from body 0 to all others.
import {product, turnAbout, turned} from "./quaternion.js";
import {isSquare, senseOf, wallOf} from "./squares.js";

const PARALLEL = 1e-12;  // rad; smaller tilts count as upright

/** Returns +1 and -1 alternating between neighbours; squares with i + j even have +1. Null if no such signs exist. */
function senses(structure, neighbours) {
  const sense = structure.bodies.map(senseOf);
  for (let first = 0; first < sense.length; ++first) {
    if (!sense[first]) sense[first] = 1;
    const queue = [first];
    for (const body of queue)
      for (const {to} of neighbours[body])
        if (!sense[to]) queue.push(to) && (sense[to] = -sense[body]);
        else if (sense[to] === sense[body]) return null;
  }
  return sense;
}

function neighboursOf(structure) {
  const neighbours = structure.bodies.map(() => []);
  structure.hinges.forEach(({bodies: [a, b]}, hinge) => {
    neighbours[a].push({to: b, hinge});
    neighbours[b].push({to: a, hinge});
  });
  return neighbours;
}

/** Orders the hinges: each leads from a known body to a new one. Null if bodies are not connected. */
function treeOf(structure, neighbours) {
  const found = structure.bodies.map((_, k) => k === 0), steps = [], queue = [0];
  for (const from of queue)
    for (const {to, hinge} of neighbours[from])
      if (!found[to]) {
        found[to] = true;
        steps.push({from, to, hinge});
        queue.push(to);
      }
  return queue.length === structure.bodies.length ? steps : null;
}

/** Returns the crease of every hinge: opposite walls of a cell belong to one crease. */
function creasesOf(structure) {
  const crease = structure.hinges.map((_, k) => k);
  const root = (k) => {
    while (crease[k] !== k) k = crease[k] = crease[crease[k]];
    return k;
  };
  for (const {hinges} of structure.cells)
    for (const side of [0, 1]) crease[root(hinges[side])] = root(hinges[side + 2]);
  return crease.map((_, k) => root(k));
}

/** Returns the direction whose first crease has shift 0: y, or x in family F3 if the walls along y have unequal
 *  tilts. */
function firstDirection(walls, family) {
  const alike = (along) => {
    const tilts = walls.filter((wall) => wall.along === along).map((wall) => wall.tilt);
    return tilts.every((tilt) => Math.abs(tilt - tilts[0]) < 1e-9);
  };
  return family === "F3" && !alike(1) ? 0 : 1;
}

/** Computes the shifts of crossing creases: cot(theta_k) = cot(theta) + shift_k for crease k.
 *  In every cell, the shift of the wall along x is that of the wall along y minus tan(b) tan(g)
 *  (model/lattice/square/family/fold_angles.hpp). */
function shiftsOf(structure, family) {
  const none = structure.hinges.map(() => 0), tilted = (along) => walls.some((w) => w.along === along && Math.abs(w.tilt) > PARALLEL);
  if (!isSquare(structure)) return none;
  const walls = structure.hinges.map((hinge) => wallOf(structure, hinge));
  if (!tilted(0) || !tilted(1)) return none;
  const crease = creasesOf(structure), first = firstDirection(walls, family), crossings = new Map();
  const cross = (from, to, change) => (crossings.get(from) ?? crossings.set(from, []).get(from)).push([to, change]);
  for (const {hinges: [p, q]} of structure.cells) {
    const [x, y] = walls[p].along === 0 ? [p, q] : [q, p], change = Math.tan(walls[x].tilt) * Math.tan(walls[y].tilt);
    cross(crease[y], crease[x], -change);
    cross(crease[x], crease[y], change);
  }
  const shift = new Map();
  for (const {hinges} of structure.cells) {
    const start = crease[hinges.find((hinge) => walls[hinge].along === first)];
    if (shift.has(start)) continue;
    shift.set(start, 0);
    const queue = [start];
    for (const from of queue)
      for (const [to, change] of crossings.get(from) ?? [])
        if (!shift.has(to)) shift.set(to, shift.get(from) + change) && queue.push(to);
  }
  return crease.map((k) => shift.get(k) ?? 0);
}

/** Returns the factor between theta and the walls' turn. Family F3 defines theta by the walls with equal tilts: the
 *  cosine of that tilt. 1 in other families. */
function cosineOfTheta(structure, family) {
  if (family !== "F3") return 1;
  const walls = structure.hinges.map((hinge) => wallOf(structure, hinge)), along = firstDirection(walls, family);
  return Math.cos(walls.find((wall) => wall.along === along).tilt);
}

/** Computes half the turn of a hinge, rad: cot(turn) = cos(tilt) (cot(theta) + shift). Exactly theta if tilt and
 *  shift are 0. */
function halfTurn(theta, cosine, shift) {
  if (cosine === 1 && shift === 0) return theta;
  const s = Math.sin(theta), c = Math.cos(theta);
  const turn = Math.atan2(s, cosine * (c + shift * s));
  return theta < 0 ? turn - (turn > 0 ? Math.PI : 0) : turn;
}

/** Makes the motion of an exact structure (as in result.json). Null if bodies are not connected, or neighbours cannot
 *  have opposite senses.
 *  @returns a function of theta (rad) that gives 7 numbers per body: x, y, z (mm), w, x, y, z */
export function exactMotion(structure, family) {
  const neighbours = neighboursOf(structure), steps = treeOf(structure, neighbours), sense = senses(structure, neighbours);
  if (!steps || !sense || !structure.bodies.length) return null;
  const shift = shiftsOf(structure, family), cosine = structure.hinges.map(({beta_rad}) => (Math.abs(beta_rad) < PARALLEL ? 1 : Math.cos(beta_rad)));
  const rest = structure.bodies.map(({position_mm}) => position_mm);
  const ofTheta = cosineOfTheta(structure, family);
  const turnOf = (hinge, theta) => 2 * halfTurn(Math.atan2(ofTheta * Math.sin(theta), Math.cos(theta)), cosine[hinge], shift[hinge]);
  const first = neighbours[0].map(({hinge}) => hinge).find((hinge) => rest[structure.hinges[hinge].bodies[0]][0] === rest[structure.hinges[hinge].bodies[1]][0]);

  /** Turns body 0 about the axis of its wall along y. */
  const start = (theta) => {
    if (first === undefined) return turnAbout([0, 0, 1], sense[0] * theta);
    return turnAbout(structure.hinges[first].axis, 0.5 * sense[0] * turnOf(first, theta));
  };
  return (theta, out = new Float64Array(7 * rest.length)) => {
    const turns = rest.map(() => null), places = rest.map(() => null);
    turns[0] = start(theta);
    places[0] = rest[0];
    for (const {from, to, hinge} of steps) {
      const {bodies: [lower], axis, point_mm: point} = structure.hinges[hinge];
      const angle = -sense[lower] * turnOf(hinge, theta) * (from === lower ? 1 : -1);
      turns[to] = product(turns[from], turnAbout(axis, angle));
      const there = turned(turns[from], [0, 1, 2].map((k) => point[k] - rest[from][k]));
      const back = turned(turns[to], [0, 1, 2].map((k) => point[k] - rest[to][k]));
      places[to] = [0, 1, 2].map((k) => places[from][k] + there[k] - back[k]);
    }
    for (let k = 0; k < rest.length; ++k) out.set(places[k], 7 * k), out.set(turns[k], 7 * k + 3);
    return out;
  };
}
