// Three-dimensional view for the report and the studio. Poses are 7 numbers per body (x, y, z in mm, w, x, y, z).
import * as THREE from "three";
import {cssColour, heat} from "./colours.js";
import {Orbit} from "./orbit.js";
import {HingeAxes} from "./hinge_axes.js";
import {Picker} from "./picking.js";
import {drawSizes} from "./picture_sizes.js";
import {Openings} from "./openings.js";
import {mesh, platesOf} from "./plates.js";
import {fillPoses, posed, poseTexture} from "./posed_material.js";
import {solidsOf} from "./solids.js";
import {standing, standOf} from "./standing.js";
import {turned} from "./quaternion.js";

const SLOW_FRAME = 45;      // ms, 22 frames per second; slower pictures are drawn with fewer pixels
const FEWEST_PIXELS = 0.5;  // per CSS pixel
const SHADOW_EVERY = 4;     // frames during the motion
const SMALLEST = 0.35;      // of the flat sheet's half diagonal: smaller shapes are not enlarged further
const STILL = 300;          // ms without a change; then all pixels are drawn once
const SUN = [-0.35, -0.45, 2.2];  // position over the reach of its light
const SOFT = 0.06;          // of the reach: width of a shadow's soft boundary
const HARD = 0xded6c4, SOFT_PART = 0xe2783c, HARD_EDGE = 0x6f6752;  // in pictures, as in docs/gallery/picture.py
const PICTURE_PIXELS = 2;   // per CSS pixel of a picture
const SLOWEST_FRAMES = 4;   // times the last frame time: on a slow machine the next frame may take as long

export class Scene {
  /** @param canvas alone in its parent box   @param options {isTaken} */
  constructor(canvas, {isTaken} = {}) {
    this.canvas = canvas;
    const inSoftware = drawsInSoftware();
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: !inSoftware, alpha: true});
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.autoUpdate = false;
    this.renderer.shadowMap.type = THREE.VSMShadowMap;
    this.world = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(28, 1, 1, 1000);
    this.thing = new THREE.Group();
    this.thing.matrixAutoUpdate = false;
    this.goal = new THREE.Group();
    this.marks = new THREE.Group();
    this.openings = new Openings();
    this.axes = new HingeAxes();
    this.thing.add(this.goal, this.marks, this.axes.object, this.openings.object);
    this.world.add(this.thing);
    this.light(inSoftware);
    this.orbit = new Orbit(this.camera, canvas, () => this.redraw(), isTaken);
    this.pixels = this.mostPixels = Math.min(2, window.devicePixelRatio || 1);
    this.held = null;
    this.rim = {value: new THREE.Color()};
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.recolour());
    this.resize();
  }

  /** @param inSoftware uses coarse shadows: their pass costs as much as everything else together */
  light(inSoftware) {
    this.sky = new THREE.HemisphereLight(0xffffff, 0xb4bcc6, 2);
    this.sky.position.set(0, 0, 1);
    this.sun = new THREE.DirectionalLight(0xffffff, 2.1);
    this.sun.castShadow = true;
    const points = inSoftware ? 256 : 512;
    this.sun.shadow.mapSize.set(points, points);
    this.sun.shadow.radius = points / 170;
    this.sun.shadow.blurSamples = 6;
    this.ground = new THREE.Mesh(new THREE.PlaneGeometry(1, 1), clearWhereLit(new THREE.ShadowMaterial({opacity: 0.22, depthWrite: false})));
    this.ground.receiveShadow = true;
    this.world.add(this.sky, this.sun, this.sun.target, this.ground);
  }

  /** Shows another structure and keeps the view if possible. @param structure as in result.json
   *  @param meshes of bodies of any shape, {bodies, hinges} of {points, triangles}; replaces walls */
  setStructure(structure, {fit = true, meshes = null} = {}) {
    this.solid?.geometry.dispose();
    this.solid?.removeFromParent();
    this.texture?.dispose();
    this.structure = structure;
    this.rest = structure.bodies.map(({position_mm}) => position_mm);
    const parts = meshes ? solidsOf(structure, meshes) : mesh(platesOf(structure));
    this.pieces = parts.pieces;
    this.boxes = parts.boxes;
    this.picker = new Picker(parts);
    this.axes.set([], structure.cell_mm);
    this.texture = poseTexture(structure.bodies.length);
    this.solid = this.solidOf(parts);
    this.thing.add(this.solid);
    this.openings.setStructure(structure);
    this.poses = Float64Array.from(this.rest.flatMap((p) => [...p, 1, 0, 0, 0]));
    this.size = meshes ? 0.5 * extentOf(this) : 0.5 * Math.max(...this.rest.map((p) => Math.hypot(...p.map((v, k) => v - this.rest[0][k]))), structure.cell_mm);
    this.held = null;
    this.rough = false;
    this.recolour();
    this.show(this.poses);
    if (fit) this.fit();
  }

  solidOf({position, normal, body, rim, index, broad}) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
    geometry.setAttribute("normal", new THREE.BufferAttribute(normal, 3));
    geometry.setAttribute("body", new THREE.BufferAttribute(body, 1));
    geometry.setAttribute("rim", new THREE.BufferAttribute(rim, 4));
    geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(position.length), 3));
    this.triangles = {all: new THREE.BufferAttribute(index, 1), broad: new THREE.BufferAttribute(broad, 1)};
    geometry.setIndex(this.triangles.all);
    const material = new THREE.MeshLambertMaterial({vertexColors: true});
    const solid = new THREE.Mesh(geometry, posed(material, this.texture, this.rim));
    solid.customDepthMaterial = posed(new THREE.MeshDepthMaterial({depthPacking: THREE.RGBADepthPacking}), this.texture);
    solid.frustumCulled = false;
    solid.castShadow = true;
    return solid;
  }

  /** Sets the poses that decide how the object stands, preferably folded ones. Without poses it keeps its own frame. */
  standBy(poses) {
    this.stand = poses ? standOf(poses, this.rest) : null;
  }

  /** Shows poses of all bodies. @param settle turns the object to stand; otherwise its orientation stays */
  show(poses, {settle = true} = {}) {
    this.poses = poses;
    fillPoses(this.texture, poses);
    this.openings.show(poses);
    this.axes.show(poses);
    if (settle || !this.held) this.held = this.stand ? standing(this.stand, poses) : [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    const [x, y, up] = this.held, m = this.thing.matrix;
    const box = this.boxOf(poses), middle = [0, 1].map((k) => 0.5 * (box.low[k] + box.high[k]));
    if (settle || !this.shift) this.shift = [-middle[0], -middle[1], -box.low[2]];
    m.set(...x, this.shift[0], ...y, this.shift[1], ...up, this.shift[2], 0, 0, 0, 1);
    this.thing.matrixWorldNeedsUpdate = true;
    this.height = box.high[2] - box.low[2];
    this.placeLight(box);
    this.moved = true;
    if (this.orbit.follows && settle) this.fit(box);
    this.redraw();
  }

  /** Draws axes of hinges: [{hinge, colour}]. */
  setAxes(chosen) {
    const {hinges, cell_mm} = this.structure;
    this.axes.set(chosen.map(({hinge, colour}) => {
      const {bodies: [body], point_mm, axis, reach_mm} = hinges[hinge];
      return {body, at: point_mm.map((v, k) => v - this.rest[body][k]), axis, half: Math.max(2.5 * reach_mm, 0.3 * cell_mm), colour};
    }), cell_mm);
    this.axes.show(this.poses);
    this.redraw();
  }

  /** Computes the bounding box of the vertices as they stand, with room for the walls; for bodies of any shape, the
   *  box of their boxes. */
  boxOf(poses) {
    if (this.boxes) return this.boxOfBoxes(poses);
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity], {held} = this;
    const half = 0.5 * (this.structure.wall_mm?.height ?? 0.6 * this.structure.cell_mm);
    for (let k = 0; k < poses.length; k += 7) {
      const normal = turned([poses[k + 3], poses[k + 4], poses[k + 5], poses[k + 6]], [0, 0, half]);
      for (let row = 0; row < 3; ++row) {
        const [a, b, c] = held[row], at = a * poses[k] + b * poses[k + 1] + c * poses[k + 2];
        const more = Math.abs(a * normal[0] + b * normal[1] + c * normal[2]);
        if (at - more < low[row]) low[row] = at - more;
        if (at + more > high[row]) high[row] = at + more;
      }
    }
    return {low, high};
  }

  boxOfBoxes(poses) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    this.boxes.forEach((corners, body) => {
      const place = poses.subarray(7 * body, 7 * body + 3), turn = [...poses.subarray(7 * body + 3, 7 * body + 7)];
      for (const corner of corners) {
        const p = turned(turn, corner).map((v, k) => v + place[k]);
        this.held.forEach((row, k) => {
          const at = row[0] * p[0] + row[1] * p[1] + row[2] * p[2];
          low[k] = Math.min(low[k], at);
          high[k] = Math.max(high[k], at);
        });
      }
    });
    return {low, high};
  }

  placeLight(box) {
    const reach = 1.25 * Math.max(this.size, 0.5 * Math.hypot(box.high[0] - box.low[0], box.high[1] - box.low[1]), this.height);
    this.sun.position.set(...SUN.map((v) => v * reach));
    Object.assign(this.sun.shadow.camera, {left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1 * reach, far: 4.5 * reach});
    this.sun.shadow.camera.updateProjectionMatrix();
    this.layGround(box, reach);
  }

  /** Makes the ground as large as the shadow, because software rendering draws every point of it, lit or not. */
  layGround({low, high}, reach) {
    const top = Math.max(0, high[2] + this.shift[2]);
    const [x, y] = [0, 1].map((k) => {
      const fall = (-SUN[k] / SUN[2]) * top, at = this.shift[k];
      return {from: low[k] + at - SOFT * reach, to: high[k] + at + fall + SOFT * reach};
    });
    this.ground.scale.set(x.to - x.from, y.to - y.from, 1);
    this.ground.position.set((x.from + x.to) / 2, (y.from + y.to) / 2, -0.002 * reach);
  }

  /** Returns the places of all bodies as they stand. */
  places() {
    const {poses, held, shift} = this;
    return Array.from({length: poses.length / 7}, (_, body) => held.map(([a, b, c], k) => a * poses[7 * body] + b * poses[7 * body + 1] + c * poses[7 * body + 2] + shift[k]));
  }

  fit({low, high} = this.boxOf(this.poses)) {
    const [x, y, z] = this.shift;
    this.orbit.fit({low: [low[0] + x, low[1] + y, low[2] + z], high: [high[0] + x, high[1] + y, high[2] + z], points: this.places()}, SMALLEST * this.size);
  }

  // ---- colours

  recolour() {
    if (!this.solid) return;
    this.palette = {plate: cssColour("plate"), soft: cssColour("soft"), bad: cssColour("bad"), chosen: cssColour("accent"), fixed: cssColour("fixed")};
    this.rim.value.copy(cssColour("plate-edge"));
    const dark = cssColour("paper").getHSL({}).l < 0.5;
    this.ground.material.opacity = dark ? 0.55 : 0.22;
    this.sky.groundColor.set(dark ? 0x4a545f : 0xb4bcc6);
    this.paint();
  }

  /** Sets numbers from 0 to 1 for every hinge (or every body), or null for plain walls. */
  setHeat(values, of = "hinge") {
    this.heat = values ? {values, of} : null;
    this.paint();
  }

  /** Sets whether cells are lit by their opening. */
  setShining(on) {
    this.openings.object.visible = on;
    if (this.underlay) this.underlay.visible = !on;  // the lamp shows the picture already
    this.ground.visible = !on;
    this.openings.show(this.poses);
    this.redraw();
  }

  /** Marks hinges and bodies: {bad: [..], chosen: [..]} are hinges, {fixed: [..], bodies (chosen): [..]} are bodies. */
  setMarked(marks) {
    this.marked = marks;
    this.paint();
  }

  colourOf({hinge, body, soft}, sets) {
    if (sets.chosen.has(hinge)) return this.palette.chosen;
    if (sets.bad.has(hinge)) return this.palette.bad;
    if (sets.bodies.has(body) && !soft) return this.palette.chosen;
    if (sets.fixed.has(body) && !soft) return this.palette.fixed;
    if (!this.heat) return soft ? this.palette.soft : this.palette.plate;
    return heat(this.heat.values[this.heat.of === "hinge" ? hinge : body] ?? 0);
  }

  paint() {
    if (!this.solid) return;
    const {bad = [], chosen = [], fixed = [], bodies = []} = this.marked ?? {};
    const sets = {bad: new Set(bad), chosen: new Set(chosen), fixed: new Set(fixed), bodies: new Set(bodies)};
    const colour = this.solid.geometry.attributes.color;
    this.pieces.forEach((piece) => {
      const {r, g, b} = this.colourOf(piece, sets);
      for (let k = 3 * piece.corners[0]; k < 3 * piece.corners[1]; k += 3) colour.array[k] = r, colour.array[k + 1] = g, colour.array[k + 2] = b;
    });
    colour.needsUpdate = true;
    this.redraw();
  }

  // ---- objects next to it

  /** Shows the goal as a ghost in a separate frame (see placeGoal): {lines: [[[x, y, z]]], bare: lines without a
   *  nearby sheet, points: [[x, y, z]], triangles: [[a, b, c]], picture: {source, corners}}. */
  setGoal(goal) {
    this.goal.clear();
    const colour = cssColour("goal"), at = (points) => new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(points.flat(), 3));
    for (const line of goal?.lines ?? []) this.goal.add(new THREE.Line(at(line), new THREE.LineBasicMaterial({color: colour})));
    for (const line of goal?.bare ?? []) this.goal.add(new THREE.Line(at(line), new THREE.LineBasicMaterial({color: cssColour("bad")})));
    if (goal?.points?.length) this.goal.add(new THREE.Points(at(goal.points), new THREE.PointsMaterial({color: colour, size: 3, sizeAttenuation: false})));
    if (goal?.triangles?.length) {
      const material = new THREE.MeshLambertMaterial({color: colour, transparent: true, opacity: 0.25, side: THREE.DoubleSide, depthWrite: false});
      const geometry = at(goal.triangles.flat());
      geometry.computeVertexNormals();
      this.goal.add(new THREE.Mesh(geometry, material));
    }
    this.underlay = goal?.picture ? underlay(goal.picture) : null;
    if (this.underlay) this.goal.add(this.underlay), (this.underlay.visible = !this.openings.object.visible);
    this.redraw();
  }

  /** Places the goal in the frame of the poses. @param placement {turn, from, to} (placement.js); null: the goal is
   *  in that frame already */
  placeGoal(placement) {
    const {turn: [w, ...v], from, to} = placement ?? {turn: [1, 0, 0, 0], from: [0, 0, 0], to: [0, 0, 0]};
    this.goal.quaternion.set(...v, w);
    this.goal.position.set(...turned([w, ...v], from).map((x, k) => to[k] - x));
    this.redraw();
  }

  /** Draws a line from a point of the object to the pointer, in the frame of the poses; null removes it. */
  setThread(from, to) {
    this.marks.clear();
    if (from && to) {
      const geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute([...from, ...to], 3));
      const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({color: cssColour("accent"), depthTest: false}));
      const dots = new THREE.Points(geometry, new THREE.PointsMaterial({color: cssColour("accent"), size: 9, sizeAttenuation: false, depthTest: false}));
      line.frustumCulled = dots.frustumCulled = false;
      this.marks.add(line, dots);
    }
    this.redraw();
  }

  // ---- pointing

  /** Returns the ray through a point of the page, in the frame of the poses. */
  ray(clientX, clientY) {
    const box = this.canvas.getBoundingClientRect();
    const at = new THREE.Vector2((2 * (clientX - box.left)) / box.width - 1, 1 - (2 * (clientY - box.top)) / box.height);
    const caster = new THREE.Raycaster();
    caster.setFromCamera(at, this.camera);
    const back = this.thing.matrix.clone().invert(), {origin, direction} = caster.ray;
    return {origin: origin.clone().applyMatrix4(back).toArray(), way: direction.clone().transformDirection(back).toArray()};
  }

  /** Returns {body, hinge, at (in the rest frame), point} under a point of the page, or null. */
  pick(clientX, clientY) {
    const {origin, way} = this.ray(clientX, clientY), found = this.picker?.pick(origin, way, this.poses);
    if (!found) return null;
    const at = found.local.map((v, k) => v + this.rest[found.body][k]);
    return {body: found.body, hinge: found.hinge, at, point: origin.map((v, k) => v + found.distance * way[k])};
  }

  /** Returns the present place of the point `at` (rest frame) of a body. */
  carried(body, at) {
    const arm = turned([...this.poses.subarray(7 * body + 3, 7 * body + 7)], at.map((v, k) => v - this.rest[body][k]));
    return arm.map((v, k) => v + this.poses[7 * body + k]);
  }

  /** Returns the point under the pointer in the plane through `point` that faces the viewer, in the frame of the
   *  poses. */
  facing(clientX, clientY, point) {
    const {origin, way} = this.ray(clientX, clientY), back = this.thing.matrix.clone().invert();
    const normal = this.camera.getWorldDirection(new THREE.Vector3()).transformDirection(back).toArray();
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const along = dot(point.map((v, k) => v - origin[k]), normal) / dot(way, normal);
    return origin.map((v, k) => v + along * way[k]);
  }

  /** Returns the place on the page of a point in the frame of the poses. */
  onPage(point) {
    const box = this.canvas.getBoundingClientRect(), at = new THREE.Vector3(...point).applyMatrix4(this.thing.matrix).project(this.camera);
    return [box.left + (0.5 + 0.5 * at.x) * box.width, box.top + (0.5 - 0.5 * at.y) * box.height];
  }

  // ---- drawing

  resize() {
    const box = this.canvas.parentElement, width = Math.max(1, box.clientWidth), height = Math.max(1, box.clientHeight);
    this.renderer.setPixelRatio(this.pixels);
    this.renderer.setSize(width, height, false);
    const before = this.camera.aspect;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (Math.abs(before - this.camera.aspect) > 0.3 && this.solid) this.fit();
    this.redraw();
  }

  redraw() {
    if (this.asked) return;
    this.asked = requestAnimationFrame((now) => this.draw(now));
  }

  draw(now) {
    this.asked = 0;
    if (this.fewPixels) this.setPixels(this.fewPixels), this.fewPixels = 0;
    this.frames = (this.frames ?? 0) + 1;
    if (this.frames % SHADOW_EVERY === 0) this.castShadow();
    this.render(this.rough ? "broad" : "all");
    requestAnimationFrame((next) => this.keepPace(next - now));
    clearTimeout(this.still);
    this.still = setTimeout(() => this.drawSharp(), Math.max(STILL, SLOWEST_FRAMES * (this.gap ?? 0)));
  }

  /** @param triangles of the plates: all, or broad, which has two fifths of the corners for motion on a slow machine */
  render(triangles) {
    this.solid?.geometry.setIndex(this.triangles[triangles]);
    this.renderer.render(this.world, this.camera);
  }

  castShadow() {
    this.renderer.shadowMap.needsUpdate = this.moved;
    this.moved = false;
  }

  /** Draws a still picture with all pixels of the screen. */
  drawSharp() {
    if (!this.moved && !this.rough && this.pixels === this.mostPixels) return;
    this.fewPixels = this.pixels === this.mostPixels ? 0 : this.pixels;
    if (this.fewPixels) this.setPixels(this.mostPixels);
    this.castShadow();
    this.render("all");
  }

  setPixels(pixels) {
    this.pixels = pixels;
    this.renderer.setPixelRatio(pixels);
  }

  /** Reduces the work during motion on a slow machine: first fewer pixels, then walls without their narrow sides. */
  keepPace(gap) {
    this.gap = gap;
    this.pace = 0.8 * (this.pace ?? 0) + 0.2 * gap;
    if (this.pace < SLOW_FRAME || this.fewPixels) return;
    if (this.pixels > FEWEST_PIXELS) this.fewPixels = Math.max(FEWEST_PIXELS, 0.8 * this.pixels);
    else this.rough = true;
    this.pace = 0;
  }

  /** Returns the view as a PNG with two pixels per CSS pixel and a transparent background. Plain walls have the colours
   *  of their materials. Lines show the outer sizes. */
  picture() {
    const {pixels, palette} = this, rim = this.rim.value.clone(), {clientWidth: width, clientHeight: height} = this.canvas;
    this.palette = {...palette, plate: new THREE.Color(HARD), soft: new THREE.Color(SOFT_PART)};
    this.rim.value.set(HARD_EDGE);
    this.paint();
    this.setPixels(PICTURE_PIXELS);
    this.castShadow();
    this.render("all");  // after a pass of shadows, three.js uploads new colours only in the second picture
    this.render("all");
    const copy = Object.assign(document.createElement("canvas"), {width: this.canvas.width, height: this.canvas.height}), context = copy.getContext("2d");
    context.drawImage(this.canvas, 0, 0);
    context.scale(copy.width / width, copy.height / height);
    const place = (point) => {
      const {x, y} = new THREE.Vector3(...point).project(this.camera);
      return [0.5 * (1 + x) * width, 0.5 * (1 - y) * height];
    };
    drawSizes(context, this.outerBox(), place, {width, height});
    this.palette = palette;
    this.rim.value.copy(rim);
    this.paint();
    this.setPixels(pixels);
    this.render("all");
    return new Promise((resolve) => copy.toBlob(resolve, "image/png"));
  }

  /** Computes the box around all corners as they stand, mm. */
  outerBox() {
    const {position, body} = this.solid.geometry.attributes, low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    const {poses} = this, at = new THREE.Vector3(), turn = new THREE.Quaternion();
    for (let k = 0; k < position.count; ++k) {
      const first = 7 * body.getX(k);
      turn.set(poses[first + 4], poses[first + 5], poses[first + 6], poses[first + 3]);
      at.fromBufferAttribute(position, k).applyQuaternion(turn);
      at.x += poses[first], at.y += poses[first + 1], at.z += poses[first + 2];
      at.applyMatrix4(this.thing.matrix).toArray().forEach((v, axis) => {
        low[axis] = Math.min(low[axis], v);
        high[axis] = Math.max(high[axis], v);
      });
    }
    return {low, high};
  }

  /** Sets whether the background is that of the page, for films, which have no transparency. */
  setOpaque(on) {
    this.renderer.setClearColor(cssColour("paper"), on ? 1 : 0);
    this.redraw();
  }
}

/** Computes the diagonal of the box around all bodies at rest, mm. */
function extentOf({boxes, rest}) {
  const points = boxes.flatMap((corners, body) => corners.map((p) => p.map((v, k) => v + rest[body][k])));
  return Math.hypot(...[0, 1, 2].map((k) => points.reduce((most, p) => Math.max(most, p[k]), -Infinity) - points.reduce((least, p) => Math.min(least, p[k]), Infinity)));
}

/** Removes the faint grey that soft shadows leave on lit ground, whose boundary would be visible. */
function clearWhereLit(material) {
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace("1.0 - getShadowMask()", "smoothstep(0.06, 1.0, 1.0 - getShadowMask())");
  };
  return material;
}

/** Returns whether there is no graphics card; edges are then drawn without antialiasing. */
function drawsInSoftware() {
  const context = document.createElement("canvas").getContext("webgl2"), names = context?.getExtension("WEBGL_debug_renderer_info");
  const name = names ? context.getParameter(names.UNMASKED_RENDERER_WEBGL) : "";
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

/** Makes a picture below the object. @param source an image or canvas   @param corners from the lower left,
 *  counter-clockwise */
function underlay({source, corners: [a, b, c, d]}) {
  const texture = new THREE.CanvasTexture(source);
  texture.magFilter = THREE.NearestFilter;
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute([a, b, c, a, c, d].flat(), 3));
  geometry.setAttribute("uv", new THREE.Float32BufferAttribute([0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1], 2));
  return new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({map: texture, transparent: true, opacity: 0.45, side: THREE.DoubleSide, depthWrite: false}));
}
