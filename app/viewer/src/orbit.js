// Camera that orbits a point, by pointer, wheel, two fingers and keys. z is up; angles in rad, lengths in mm.
import * as THREE from "three";

const TURN = 0.008;       // rad per pixel
const KEY_TURN = 0.12;    // rad per key press
const ZOOM = 1.15;        // factor per key press
const ROOM = 0.86;        // fraction of the picture that the object fills
const HIGHEST = Math.PI / 2 - 0.001;
export const VIEWS = {slant: [-0.6, 0.45], front: [0, 0.02], side: [Math.PI / 2, 0.02], top: [0, HIGHEST]};

/** Returns whether a turn of the wheel zooms. In a page that scrolls it needs Ctrl, which a pinch on a touchpad has too. */
function zoomsBy({ctrlKey, metaKey}) {
  const {scrollHeight, clientHeight} = document.documentElement;
  return ctrlKey || metaKey || Boolean(document.fullscreenElement) || scrollHeight <= clientHeight;
}

export class Orbit {
  /** @param changed called after a change of the view   @param isTaken whether another tool uses this pointer event */
  constructor(camera, element, changed, isTaken = () => false) {
    Object.assign(this, {camera, element, changed, isTaken, centre: new THREE.Vector3(), pointers: new Map()});
    [this.azimuth, this.elevation] = VIEWS.slant;
    this.distance = 300;
    this.listen();
  }

  view(name) {
    [this.azimuth, this.elevation] = VIEWS[name];
    this.turned();
  }

  /** Fits a box {low, high} into the view from the present direction, and its points [[x, y, z]] into the middle. The
   *  fit stays active until the user zooms or pans. */
  fit({low, high, points}, least = 0) {
    Object.assign(this, {follows: true, box: {low, high, points}, least});
    this.centre.set(...low.map((v, k) => 0.5 * (v + high[k])));
    this.radius = Math.max(1e-3, least, 0.5 * Math.hypot(...low.map((v, k) => high[k] - v)));
    this.distance = this.distanceOf(low.map((v, k) => 0.5 * (high[k] - v)));
    this.place();
    this.centreOn(points);
    this.apply();
  }

  /** Shifts the centre until the points are in the middle of the picture. */
  centreOn(points) {
    const {elements: m} = this.camera.matrixWorld, low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    for (const [x, y, z] of points) {
      const v = [x - m[12], y - m[13], z - m[14]], along = (k) => v[0] * m[k] + v[1] * m[k + 1] + v[2] * m[k + 2], depth = -along(8);
      for (const axis of [0, 1]) {
        const at = along(4 * axis) / depth;
        low[axis] = Math.min(low[axis], at);
        high[axis] = Math.max(high[axis], at);
      }
    }
    const [dx, dy] = low.map((v, axis) => 0.5 * this.distance * (v + high[axis]));
    if (points.length) this.centre.add(new THREE.Vector3(dx * m[0] + dy * m[4], dx * m[1] + dy * m[5], dx * m[2] + dy * m[6]));
  }

  /** Computes the distance at which a box with these half sizes fills the picture. */
  distanceOf(half) {
    const {azimuth: a, elevation: e, camera} = this, tall = ROOM * Math.tan((0.5 * camera.fov * Math.PI) / 180), wide = tall * camera.aspect;
    const right = [Math.cos(a), Math.sin(a), 0], near = [Math.sin(a) * Math.cos(e), -Math.cos(a) * Math.cos(e), Math.sin(e)];
    const up = [-Math.sin(a) * Math.sin(e), Math.cos(a) * Math.sin(e), Math.cos(e)];
    let most = this.least / tall;
    for (let corner = 0; corner < 8; ++corner) {
      const at = half.map((v, k) => (corner & (1 << k) ? v : -v)), along = (way) => at[0] * way[0] + at[1] * way[1] + at[2] * way[2];
      most = Math.max(most, Math.max(Math.abs(along(up)) / tall, Math.abs(along(right)) / wide) + along(near));
    }
    return most;
  }

  /** Places the camera. */
  place() {
    const {camera, centre, azimuth, elevation, distance} = this, flat = Math.cos(elevation);
    camera.position.set(Math.sin(azimuth) * flat, -Math.cos(azimuth) * flat, Math.sin(elevation)).multiplyScalar(distance).add(centre);
    camera.up.set(0, 0, 1);
    camera.lookAt(centre);
    camera.near = Math.max(0.01 * distance, distance - 6 * (this.radius ?? distance));
    camera.far = distance + 12 * (this.radius ?? distance);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
  }

  apply() {
    this.place();
    this.changed();
  }

  turn(dx, dy) {
    this.azimuth -= dx;
    this.elevation = Math.max(-HIGHEST, Math.min(HIGHEST, this.elevation + dy));
    this.turned();
  }

  turned() {
    if (this.follows) this.fit(this.box, this.least);
    else this.apply();
  }

  zoom(factor) {
    this.follows = false;
    this.distance = Math.max(0.1 * (this.radius ?? 10), Math.min(20 * (this.radius ?? 1000), this.distance * factor));
    this.apply();
  }

  /** Pans by pixels on the screen. */
  pan(dx, dy) {
    this.follows = false;
    const mmPerPixel = (2 * this.distance * Math.tan((0.5 * this.camera.fov * Math.PI) / 180)) / (this.element.clientHeight || 1);
    const right = new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0);
    const up = new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, 1);
    this.centre.addScaledVector(right, -dx * mmPerPixel).addScaledVector(up, dy * mmPerPixel);
    this.apply();
  }

  listen() {
    const {element} = this;
    element.addEventListener("pointerdown", (event) => this.down(event));
    element.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"]) element.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
    element.addEventListener("wheel", (event) => {
      if (!zoomsBy(event)) return;
      event.preventDefault();
      this.zoom(Math.exp(0.0012 * event.deltaY * (event.deltaMode === 1 ? 30 : 1)));
    }, {passive: false});
    element.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  down(event) {
    if (this.isTaken(event)) return;
    this.element.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
  }

  move(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const dx = event.clientX - before[0], dy = event.clientY - before[1], spread = this.spread();
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (this.pointers.size === 1) return event.buttons & 6 || event.ctrlKey ? this.pan(dx, dy) : this.turn(TURN * dx, TURN * dy);
    this.pan(dx / 2, dy / 2);
    if (spread > 0 && this.spread() > 0) this.zoom(spread / this.spread());
  }

  spread() {
    const [a, b] = [...this.pointers.values()];
    return a && b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
  }

  /** Handles keys: arrows turn, with Shift they pan; + and - zoom. Returns whether the key was handled. */
  key(event) {
    const way = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
    if (way && event.shiftKey) this.pan(30 * way[0], 30 * way[1]);
    else if (way) this.turn(-KEY_TURN * way[0], -KEY_TURN * way[1]);
    else if (event.key === "+" || event.key === "=") this.zoom(1 / ZOOM);
    else if (event.key === "-") this.zoom(ZOOM);
    else return false;
    return true;
  }
}
