// Section 3: the folded sheet in space on a canvas, painted from back to front.

const VIEWS = { Slant: [-0.6, 0.45], Side: [0, 0], Top: [0, Math.PI / 2], End: [Math.PI / 2, 0] };

/** Right, up and away from the viewer, for a camera turned by `azimuth` about z and raised by `elevation`. */
function camera(azimuth, elevation) {
  const c = Math.cos(azimuth), s = Math.sin(azimuth), ce = Math.cos(elevation), se = Math.sin(elevation);
  return { right: [c, s, 0], up: [-s * se, c * se, ce], away: [-s * ce, c * ce, -se] };
}

function centredFaces(structure, state, parts) {
  const centre = mean(state.poses.map((pose) => pose.p));
  return parts.map((plate) => carriedPlate(structure, state, plate).corners.map((corner) => subtract(corner, centre)));
}

function reachOf(faces) {
  return Math.max(...faces.flatMap((face) => face.map((corner) => Math.hypot(...corner))), 1e-9);
}

function litColour(face, eye, base) {
  const normal = unit(cross(subtract(face[1], face[0]), subtract(face[3], face[0])));
  const light = unit(add(add(scale(eye.right, -0.4), scale(eye.up, 0.7)), scale(eye.away, -0.6)));
  return blend(base, colour("shade"), 0.55 * (1 - Math.abs(dot(normal, light))));
}

function sizedContext(canvas, width, height) {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  canvas.style.height = height + "px";
  const context = canvas.getContext("2d");
  context.scale(ratio, ratio);
  return context;
}

function paintFace(context, corners, fillColour, edge) {
  context.beginPath();
  corners.forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
  context.closePath();
  context.fillStyle = fillColour;
  context.strokeStyle = edge;
  context.fill();
  context.stroke();
}

function scaleBar(context, perMm, width, height) {
  const length = niceStep(width / perMm, 4);
  context.strokeStyle = context.fillStyle = colour("muted");
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(14, height - 14);
  context.lineTo(14 + length * perMm, height - 14);
  context.stroke();
  context.font = "12px system-ui, sans-serif";
  context.fillText(`${figures(length, 2)} mm`, 14, height - 22);
}

function paint(canvas, scene, width) {
  const height = Math.round(Math.min(460, Math.max(260, width * 0.5)));
  const context = sizedContext(canvas, width, height), eye = camera(scene.azimuth, scene.elevation);
  const stop = scene.stops[scene.stop], perMm = (0.94 * Math.min(width / 2, height * 0.9)) / scene.reach;
  const to = (p) => [width / 2 + dot(p, eye.right) * perMm, height / 2 - dot(p, eye.up) * perMm];
  const faces = stop.faces.map((face) => ({ face, depth: dot(mean(face), eye.away) })).sort((a, b) => b.depth - a.depth);
  const base = colour(stop.look), edge = colour("edge");
  context.lineWidth = 0.7;
  for (const { face } of faces) paintFace(context, face.map(to), litColour(face, eye, base), edge);
  scaleBar(context, perMm, width, height);
}

/** Everything that can be shown, flat first; the physics run last. */
function stopsOf({ structure, states }) {
  const parts = plates(structure);
  const stop = (state, look, text) => ({ look, text, faces: centredFaces(structure, state, parts) });
  const frames = states.frames.map((state) => stop(state, "model", `\u03b8 ${degrees(toDegrees(state.theta))}`));
  const final = states.model ? [stop(states.model, "model", states.model.theta === null ? "folded" : `\u03b8 ${degrees(toDegrees(states.model.theta))}`)] : [];
  const flat = states.flat && !(states.frames[0]?.theta < 1e-6) ? [stop(states.flat, "model", "flat")] : [];
  return { motion: [...flat, ...frames, ...final], physics: states.physics ? stop(states.physics, "physics", "physics run") : null };
}

function turnByDrag(canvas, scene, repaint) {
  let from = null;
  canvas.addEventListener("pointerdown", (event) => {
    from = [event.clientX, event.clientY];
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!from) return;
    turnBy(scene, event.clientX - from[0], event.clientY - from[1]);
    from = [event.clientX, event.clientY];
    repaint();
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { from = null; });
}

function turnBy(scene, dx, dy) {
  scene.azimuth -= dx * 0.01;
  scene.elevation = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, scene.elevation + dy * 0.01));
}

function turnByKeys(canvas, scene, repaint) {
  const steps = { ArrowLeft: [-10, 0], ArrowRight: [10, 0], ArrowUp: [0, -10], ArrowDown: [0, 10] };
  canvas.addEventListener("keydown", (event) => {
    if (!steps[event.key]) return;
    event.preventDefault();
    turnBy(scene, ...steps[event.key]);
    repaint();
  });
}

function viewButtons(scene, repaint) {
  return Object.entries(VIEWS).map(([name, [azimuth, elevation]]) =>
    html("button", { type: "button", click: () => { Object.assign(scene, { azimuth, elevation }); repaint(); } }, name));
}

function choice(name, text, checked, change) {
  return html("label", {}, html("input", { type: "radio", name, change, ...(checked ? { checked: "" } : {}) }), text);
}

function motionControl(motion, scene, repaint) {
  const last = motion.length - 1;
  const readout = html("output", {}, motion[last].text);
  const slider = html("input", { type: "range", min: 0, max: last, step: 1, value: last, "aria-label": "Fold angle" });
  slider.addEventListener("input", () => {
    scene.stop = Number(slider.value);
    readout.textContent = motion[scene.stop].text;
    repaint();
  });
  return { slider, box: html("label", { class: "slider" }, "flat", slider, "folded ", readout) };
}

function controls(scene, motion, repaint) {
  const motionBox = motion.length > 1 ? motionControl(motion, scene, repaint) : null;
  const show = (stop) => () => {
    const physics = stop === "physics";
    scene.stop = physics ? scene.stops.length - 1 : Number(motionBox?.slider.value ?? 0);
    if (motionBox) motionBox.slider.disabled = physics;
    repaint();
  };
  const hasPhysics = scene.stops.length > motion.length;
  return html("div", { class: "controls" },
    hasPhysics ? html("fieldset", {}, choice("source", "model", true, show("model")), choice("source", "physics run", false, show("physics"))) : null,
    motionBox?.box, html("div", { class: "buttons" }, viewButtons(scene, repaint)));
}

function spaceSection(data) {
  const { motion, physics } = stopsOf(data);
  if (!motion.length || !data.structure.hinges.length) return missing("This result holds no state to draw.");
  const stops = physics ? [...motion, physics] : motion;
  const scene = { stops, stop: motion.length - 1, azimuth: VIEWS.Slant[0], elevation: VIEWS.Slant[1], reach: Math.max(...stops.map((s) => reachOf(s.faces))) };
  const canvas = html("canvas", { tabindex: 0, role: "img", "aria-label": "The folded sheet in space; drag or use the arrow keys to turn it" });
  const box = responsive((width) => { paint(canvas, scene, width); return canvas; });
  const repaint = () => redraw(box);
  turnByDrag(canvas, scene, repaint);
  turnByKeys(canvas, scene, repaint);
  return [controls(scene, motion, repaint), box,
    html("p", { class: "note" }, "Drag to turn it. The slider folds the sheet from flat to the target; all pictures have the same scale.")];
}
