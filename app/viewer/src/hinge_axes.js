// Axes of chosen or turned hinges, drawn as rods that are visible through other objects.
import * as THREE from "three";
import {cssColour} from "./colours.js";
import {turned} from "./quaternion.js";

const THICK = 0.008;  // radius of a rod over the cell edge

export class HingeAxes {
  constructor() {
    this.object = new THREE.Group();
    this.rods = [];
  }

  /** @param axes [{body, at (from the body's rest position), axis, half, colour}], lengths in mm   @param edge mm */
  set(axes, edge) {
    for (const {rod} of this.rods) rod.geometry.dispose(), rod.material.dispose();
    this.object.clear();
    this.rods = axes.map((each) => {
      const geometry = new THREE.CylinderGeometry(THICK * edge, THICK * edge, 2 * each.half, 8);
      const rod = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({color: cssColour(each.colour), depthTest: false, transparent: true}));
      rod.frustumCulled = false;
      this.object.add(rod);
      return {...each, rod};
    });
  }

  show(poses) {
    for (const {rod, body, at, axis} of this.rods) {
      const turn = [...poses.subarray(7 * body + 3, 7 * body + 7)], place = turned(turn, at);
      rod.position.set(...place.map((v, k) => v + poses[7 * body + k]));
      rod.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), new THREE.Vector3(...turned(turn, axis)).normalize());
    }
  }
}
