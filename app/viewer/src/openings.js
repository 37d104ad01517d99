// Cells as a lamp behind the panel shows them: the wider one stands open, the brighter.
import * as THREE from "three";
import {turned} from "./quaternion.js";

export class Openings {
  constructor() {
    const material = new THREE.MeshBasicMaterial({vertexColors: true, side: THREE.DoubleSide});
    this.object = new THREE.Mesh(new THREE.BufferGeometry(), material);
    this.object.frustumCulled = false;
    this.object.visible = false;
  }

  setStructure(structure) {
    this.structure = structure;
    const corners = structure.cells.map(({bodies}) => 2 * bodies.length), triangles = corners.reduce((sum, n) => sum + n - 2, 0);
    this.object.geometry.dispose();
    this.object.geometry = new THREE.BufferGeometry();
    for (const name of ["position", "color"]) this.object.geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(9 * triangles), 3));
    this.flat = structure.cells.map((cell) => this.area(this.outline(cell, null)));
  }

  /** Vertices and hinge points round a cell, in turn. @param poses null for flat */
  outline({bodies, hinges}, poses) {
    const {structure} = this;
    return bodies.flatMap((body, k) => {
      const rest = structure.bodies[body].position_mm, point = structure.hinges[hinges[k]].point_mm;
      if (!poses) return [rest, point];
      const at = [...poses.subarray(7 * body, 7 * body + 3)], arm = turned([...poses.subarray(7 * body + 3, 7 * body + 7)], point.map((v, c) => v - rest[c]));
      return [at, at.map((v, c) => v + arm[c])];
    });
  }

  area(points) {
    const n = points.length;
    return Math.abs(0.5 * points.reduce((sum, [x, y], k) => sum + x * points[(k + 1) % n][1] - y * points[(k + 1) % n][0], 0));
  }

  show(poses) {
    if (!this.object.visible || !poses) return;
    const outlines = this.structure.cells.map((cell) => this.outline(cell, poses)), open = outlines.map((points, k) => this.area(points) / (this.flat[k] || 1));
    const sorted = [...open].sort((a, b) => a - b), low = sorted[Math.floor(0.02 * sorted.length)], high = Math.max(sorted[Math.floor(0.98 * sorted.length)], low + 1e-3);
    const {position, color} = this.object.geometry.attributes;
    let at = 0;
    outlines.forEach((points, k) => {
      const bright = Math.max(0, Math.min(1, (open[k] - low) / (high - low))), shade = [0.16 + 0.84 * bright, 0.15 + 0.72 * bright, 0.13 + 0.32 * bright];
      for (const triangle of fan(points)) for (const point of triangle) position.array.set(point, at), color.array.set(shade, at), (at += 3);
    });
    position.needsUpdate = color.needsUpdate = true;
  }
}

/** Triangles that cover an outline that need not be convex. */
function fan(points) {
  const flat = points.map(([x, y]) => new THREE.Vector2(x, y));
  const triangles = THREE.ShapeUtils.triangulateShape(flat, []).map((corners) => corners.map((k) => points[k]));
  while (triangles.length < points.length - 2) triangles.push([points[0], points[0], points[0]]);
  return triangles;
}
