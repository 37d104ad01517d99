// Cells with a lamp behind the panel: a wider opening is brighter.
import * as THREE from "three";
import {areaWithin, cellOutline} from "./cell_outline.js";

export class Openings {
  constructor() {
    const material = new THREE.MeshBasicMaterial({vertexColors: true, side: THREE.DoubleSide});
    this.object = new THREE.Mesh(new THREE.BufferGeometry(), material);
    this.object.frustumCulled = false;
    this.object.visible = false;
  }

  setStructure(structure) {
    this.structure = structure;
    const corners = structure.cells.map(({bodies}) => 3 * bodies.length), triangles = corners.reduce((sum, n) => sum + n - 2, 0);
    this.object.geometry.dispose();
    this.object.geometry = new THREE.BufferGeometry();
    for (const name of ["position", "color"]) this.object.geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(9 * triangles), 3));
    this.flat = structure.cells.map((cell) => areaWithin(cellOutline(structure, cell, null)));
  }

  show(poses) {
    if (!this.object.visible || !poses) return;
    const outlines = this.structure.cells.map((cell) => cellOutline(this.structure, cell, poses)), open = outlines.map((points, k) => areaWithin(points) / (this.flat[k] || 1));
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

/** Triangulates an outline, which need not be convex. */
function fan(points) {
  const flat = points.map(([x, y]) => new THREE.Vector2(x, y));
  const triangles = THREE.ShapeUtils.triangulateShape(flat, []).map((corners) => corners.map((k) => points[k]));
  while (triangles.length < points.length - 2) triangles.push([points[0], points[0], points[0]]);
  return triangles;
}
