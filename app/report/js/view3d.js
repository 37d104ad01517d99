// Folded sheet in space on a canvas, painted from back to front. It replaces scene_view.js if there is no scene.

const SCALE_BAR_PX = 46;
const VIEWS = {
  Slant: [-0.6, 0.45],
  Side: [0, 0],
  Top: [0, Math.PI / 2],
  End: [Math.PI / 2, 0]
};

/** Returns the axes right, up and away of a camera turned by `azimuth` about z and raised by `elevation`, rad. */
function camera(azimuth, elevation) {
  const c = Math.cos(azimuth), s = Math.sin(azimuth), ce = Math.cos(elevation), se = Math.sin(elevation);
  return {right: [c, s, 0], up: [-s * se, c * se, ce], away: [-s * ce, c * ce, -se]};
}

// Returns a rotation about y that makes the strip's longest direction horizontal, with its middle pointing right.
// The pose of the first body alone would show arches on their side.
function levelling(line) {
  const flat = line.map((p) => [p[0], p[2]]), centre = mean(flat), middle = Math.floor(line.length / 2);
  const [xx, xz, zz] =
      flat.map((p) => subtract(p, centre)).reduce((sum, [x, z]) => add(sum, [x * x, x * z, z * z]), [
        0, 0, 0
      ]);
  const along = subtract(flat[Math.min(flat.length - 1, middle + 1)], flat[Math.max(0, middle - 1)]);
  const angle = 0.5 * Math.atan2(2 * xz, xx - zz),
        ahead = dot(along, [Math.cos(angle), Math.sin(angle)]) < 0 ? -1 : 1;
  const c = ahead * Math.cos(angle), s = ahead * Math.sin(angle);
  return ([x, y, z]) => [c * x + s * z, y, c * z - s * x];
}

/** Returns the backdrop lines behind the folded shape, about the same centre. */
function centredLines(data, state) {
  const centre = mean(state.poses.map((pose) => pose.p));
  return (data.goal?.backdrop ?? []).map((points) => points.map((p) => subtract(p, centre)));
}

function paintLines(context, lines, to) {
  context.strokeStyle = colour("muted");
  for (const line of lines) {
    context.beginPath();
    line.map(to).forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
    context.stroke();
  }
}

function centredFaces(structure, state, parts, level) {
  const turn = level ? levelling(midline(structure, state)) : (p) => p;
  const centre = mean(state.poses.map((pose) => pose.p));
  return parts.map(
      (plate) =>
          carriedPlate(structure, state, plate).corners.map((corner) => turn(subtract(corner, centre))));
}

/** Returns the largest scale at which all faces fit. */
function fittingScale(faces, eye, width, height) {
  let across = 1e-9, upward = 1e-9;
  for (const face of faces)
    for (const corner of face) {
      across = Math.max(across, Math.abs(dot(corner, eye.right)));
      upward = Math.max(upward, Math.abs(dot(corner, eye.up)));
    }
  return Math.min((width / 2 - 16) / across, (height / 2 - SCALE_BAR_PX) / upward);
}

function litColour(face, eye, lit, shade) {
  const normal = unit(cross(subtract(face[1], face[0]), subtract(face[face.length - 1], face[0])));
  const light = unit(add(add(scale(eye.right, -0.4), scale(eye.up, 0.7)), scale(eye.away, -0.6)));
  return blend(lit, shade, 0.85 * (1 - Math.abs(dot(normal, light))));
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
  const length = niceStep(width / perMm, 8);
  context.strokeStyle = context.fillStyle = colour("muted");
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(14, height - 14);
  context.lineTo(14 + length * perMm, height - 14);
  context.stroke();
  context.font = "12px system-ui, sans-serif";
  context.fillText(`${neat(length)} mm`, 14, height - 22);
}

/** Returns the scale of a stop. It may grow during folding, because a common scale would make a folded strip small. */
function sceneScale(scene, stop, eye, width, height) {
  const common = fittingScale(scene.stops.flatMap((each) => each.faces), eye, width, height);
  return Math.min(fittingScale(stop.faces, eye, width, height), 1.8 * common);
}

function paint(canvas, scene, width) {
  const height = Math.round(Math.min(460, Math.max(260, width * 0.5)));
  const context = sizedContext(canvas, width, height), eye = camera(scene.azimuth, scene.elevation);
  const stop = scene.stops[scene.stop], perMm = sceneScale(scene, stop, eye, width, height);
  const to = (p) => [width / 2 + dot(p, eye.right) * perMm, height / 2 - dot(p, eye.up) * perMm];
  const faces =
      stop.faces.map((face) => ({face, depth: dot(mean(face), eye.away)})).sort((a, b) => b.depth - a.depth);
  const lit = colour(stop.look + "-plate"), shade = colour(stop.look + "-shade");
  context.lineWidth = 0.7;
  paintLines(context, stop.lines, to);
  for (const {face} of faces) paintFace(context, face.map(to), litColour(face, eye, lit, shade), shade);
  scaleBar(context, perMm, width, height);
}

/** Returns all states that can be shown: flat first, the simulation last. */
function stopsOf(data) {
  const {structure, states} = data, parts = plates(structure), level = seenFromSide(data);
  const stop = (state, look, text) => ({
    look, text, faces: centredFaces(structure, state, parts, level), lines: state === states.flat ? [] : centredLines(data, state)
  });
  const frames =
      states.frames.map((state) => stop(state, "model", `fold angle ${degrees(toDegrees(state.theta))}`));
  const final = states.model ?
      [stop(
          states.model, "model",
          states.model.theta === null ? "folded" : `fold angle ${degrees(toDegrees(states.model.theta))}`)] :
      [];
  const flat = states.flat && !(states.frames[0]?.theta < 1e-6) ? [stop(states.flat, "model", "flat")] : [];
  return {
    motion: [...flat, ...frames, ...final],
    physics: states.physics ? stop(states.physics, "physics", "simulation") : null
  };
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
  for (const end of ["pointerup", "pointercancel"])
    canvas.addEventListener(end, () => {
      from = null;
    });
}

function turnBy(scene, dx, dy) {
  scene.azimuth -= dx * 0.01;
  scene.elevation = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, scene.elevation + dy * 0.01));
}

function turnByKeys(canvas, scene, repaint) {
  const steps = {ArrowLeft: [-10, 0], ArrowRight: [10, 0], ArrowUp: [0, -10], ArrowDown: [0, 10]};
  canvas.addEventListener("keydown", (event) => {
    if (!steps[event.key]) return;
    event.preventDefault();
    turnBy(scene, ...steps[event.key]);
    repaint();
  });
}

function viewButtons(scene, repaint) {
  return Object.entries(VIEWS).map(
      ([name, [azimuth, elevation]]) => html(
          "button", {
            type: "button",
            click: () => {
              Object.assign(scene, {azimuth, elevation});
              repaint();
            }
          },
          name));
}

function choice(name, text, checked, change) {
  return html(
      "label", {}, html("input", {type: "radio", name, change, ...(checked ? {checked: ""} : {})}), text);
}

function motionControl(motion, scene, repaint) {
  const last = motion.length - 1;
  const readout = html("output", {}, motion[last].text);
  const slider =
      html("input", {type: "range", min: 0, max: last, step: 1, value: last, "aria-label": "Fold angle"});
  slider.addEventListener("input", () => {
    scene.stop = Number(slider.value);
    readout.textContent = motion[scene.stop].text;
    repaint();
  });
  return {slider, box: html("label", {class: "slider"}, "flat", slider, "folded ", readout)};
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
  return html(
      "div", {class: "controls"},
      hasPhysics ? html(
                       "fieldset", {}, choice("source", "model", true, show("model")),
                       choice("source", "simulation", false, show("physics"))) :
                   null,
      motionBox?.box, html("div", {class: "buttons"}, viewButtons(scene, repaint)));
}

function spaceSection(data) {
  const {hinges, isBodies, meshes} = data.structure;
  if (isBodies && !meshes) return missing("The surfaces of its bodies are not on this page; the studio shows them.");
  if (data.states.model && hinges.length && hasScene()) return sceneSection(data);
  const {motion, physics} = stopsOf(data);
  if (!motion.length || !hinges.length) return missing("This result holds no state to draw.");
  const stops = physics ? [...motion, physics] : motion;
  const scene = {stops, stop: motion.length - 1, azimuth: VIEWS.Slant[0], elevation: VIEWS.Slant[1]};
  const canvas = html("canvas", {
    tabindex: 0,
    role: "img",
    "aria-label": "The folded sheet in space; drag or use the arrow keys to turn it"
  });
  const box = responsive((width) => {
    paint(canvas, scene, width);
    return canvas;
  });
  const repaint = () => redraw(box);
  turnByDrag(canvas, scene, repaint);
  turnByKeys(canvas, scene, repaint);
  return [
    controls(scene, motion, repaint), box,
    html(
        "p", {class: "note on-screen"},
        "Drag to turn it. The slider folds the sheet from flat to the target.")
  ];
}
