// Interactive view of the folded sheet: rotate, play, take pictures. It needs the script of the scene in the page and a
// browser with WebGL 2. Otherwise the page uses view3d.js.

const NEAR_GOAL = 0.06;  // rad of theta: the goal is drawn only if theta is this near to it
const SAME_THETA = 1e-3; // rad: smaller differences between drive and sheet count as one theta
const PLAY_S = 5;        // seconds of the motion there and back

function hasScene() {
  if (typeof KinetixScene === "undefined") return false;
  const context = document.createElement("canvas").getContext("webgl2");
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return context !== null;
}

function numbersOf(state) {
  return Float64Array.from(state.poses.flatMap((pose) => [...pose.p, ...pose.q]));
}

/** Returns the theta of the drive at the model's state, rad. For an equilibrium it is the end of the drive's motion. */
function wayOf(model, frames) {
  if (model.model !== "equilibrium" || !frames.length) return model.theta;
  return frames.reduce((end, {theta}) => (Math.abs(theta) > Math.abs(end) ? theta : end), 0);
}

// Returns the motion: {poses(theta), from, to (rad), words, at (theta of the state at `to`, rad)}.
// It uses the closed form, or interpolates between stored states. The reported state is at `to`.
function motionOf(data) {
  const {model, frames, flat} = data.states, {family} = data.plan, to = model.theta ?? 0;
  const exact = family !== "none" && model.model === "exact" && to !== 0 ? KinetixScene.exactMotion(data.raw.structure, family) : null;
  if (exact) return {poses: exact, from: 0, to, at: to, words: "The slider computes every position from the analytic motion of the sheet."};
  const end = wayOf(model, frames), before = frames.filter(({theta}) => theta !== end);
  const stored = [...before, ...(end === null ? [] : [{...model, theta: end}])].map((state) => ({theta: state.theta, poses: numbersOf(state)}));
  if (flat && !(stored[0]?.theta < 1e-6)) stored.unshift({theta: 0, poses: numbersOf(flat)});
  const known = stored.sort((a, b) => a.theta - b.theta).filter((state, k) => k === 0 || state.theta > stored[k - 1].theta);
  if (known.length < 2) return {poses: () => numbersOf(model), from: to, to, at: to, words: "One computed state."};
  const other = Math.abs(to - end) > SAME_THETA;
  return {poses: KinetixScene.storedMotion(known), from: end < 0 ? known[known.length - 1].theta : known[0].theta, to: end, at: to, ofDrive: other,
    words: `The slider shows ${known.length} computed states, and interpolates between them.` +
        (other ? ` The state that was reached has the fold angle ${degrees(toDegrees(to))}. Fold angles before it are those of the drive, ${degrees(toDegrees(end))} at its end.` : "")};
}

/** Returns a map from the frame of the results to the frame of the motion. Both share body 0. */
function intoMotion(state, poses) {
  const {p, q} = state.poses[0], back = [q[0], -q[1], -q[2], -q[3]];
  return (point) => add(turned([...poses.slice(3, 7)], turned(back, subtract(point, p))), [...poses.slice(0, 3)]);
}

/** Returns the triangles of a flat convex face. */
function fan(face) {
  return face.slice(2).map((corner, k) => [face[0], face[k + 1], corner]);
}

/** Returns the drawing of the goal: faces of a solid, a ribbon for a strip, a picture below a panel, the lines of a head. */
function goalOf(data, motion) {
  const {model} = data.states, to = intoMotion(model, motion.poses(motion.to)), goal = seenFromSide(data) ? data.goal?.goal ?? [] : [];
  const lines = [...(data.goal?.backdrop ?? []), ...(data.goal?.ideal ?? [])].map((line) => line.map(to));
  if (data.goal?.under?.length) {
    const {source, corners} = KinetixScene.pictureUnder(data.goal.under, model.poses.map((pose) => pose.p), data.structure.height);
    return {lines, picture: {source, corners: corners.map(to)}};
  }
  if (goal.length < 2) return {lines, triangles: (data.goal?.ideal ?? []).flatMap((face) => fan(face.map(to)))};
  const ys = model.poses.map((pose) => pose.p[1]), more = 0.75 * data.structure.cell;
  const [front, back] = [Math.min(...ys) - more, Math.max(...ys) + more].map((y) => goal.map(([x, z]) => to([x, y, z])));
  const triangles = goal.slice(1).flatMap((_, k) => [[front[k], front[k + 1], back[k + 1]], [front[k], back[k + 1], back[k]]]);
  return {lines: [...lines, front, back], triangles};
}

/** Returns the structure of the result with wall sizes filled in if the file has none. */
function fullStructure(data) {
  const {raw, structure} = data;
  return {...raw.structure, wall_mm: {thickness: structure.thickness, height: structure.height}};
}

/** Converts numbers to shares of the largest; unknown numbers become 0. @param of "hinge" or "body" */
function shares(numbers, of) {
  const sizes = numbers.map((value) => Math.abs(value ?? 0)), most = Math.max(...sizes, 1e-9);
  return {values: sizes.map((size) => size / most), of, most};
}

class SceneView {
  constructor(data) {
    this.data = data;
    this.motion = motionOf(data);
    this.theta = this.motion.to;
    this.canvas = html("canvas", {tabindex: 0, role: "img", "aria-label":
        "The folded sheet in space; drag or use the arrow keys to turn it, Shift and arrow keys to shift it, plus and minus to zoom"});
    this.stage = html("div", {class: "stage"}, this.canvas);
    this.canvas.addEventListener("keydown", (event) => {
      if (!this.scene.orbit.key(event)) return;
      event.preventDefault();
      this.scene.draw(performance.now());
    });
    this.canvas.addEventListener("click", (event) => this.name(event));
    window.addEventListener("beforeprint", () => this.scene);
    // The second animation frame starts after the browser has painted the first picture.
    requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(() => this.scene)));
  }

  /** Makes the scene after the page's first picture, or at its first use. It takes as long as the rest of the page. */
  get scene() {
    if (this.made) return this.made;
    const {data, motion} = this;
    this.made = new KinetixScene.Scene(this.canvas);
    this.made.setStructure(fullStructure(data), {fit: false, meshes: data.structure.meshes});
    this.made.standBy(data.structure.isBodies ? null : motion.poses(motion.to));
    this.made.setGoal(goalOf(data, motion));
    this.made.orbit.view(data.view === "top" ? "top" : "slant");
    this.show(this.theta);
    this.made.fit();
    this.fitInPlace();
    return this.made;
  }

  fitInPlace() {
    this.made.recolour();
    if (!this.stage.isConnected) return;
    this.made.resize();
    this.made.draw(performance.now());
  }

  /** Marks and names the body or hinge under the pointer. */
  name({clientX, clientY}) {
    const found = this.scene.pick(clientX, clientY), {bodies, hinges, isBodies} = this.data.structure, isHinge = found?.hinge !== undefined;
    this.scene.setMarked(!found ? {} : isHinge ? {chosen: [found.hinge]} : {bodies: [found.body]});
    this.named.textContent = found && isBodies ? (isHinge ? hinges[found.hinge] : bodies[found.body]).name : found ? `body ${found.body}, hinge ${found.hinge}: tilt ${degrees(toDegrees(this.data.structure.hinges[found.hinge]?.beta ?? 0))}` : "";
  }

  /** Returns the quantities that colours can show, each as shares from 0 to 1 of hinges or bodies. */
  colours() {
    const {structure, raw} = this.data;
    const out = structure.isBodies ? {} : {tilt: {text: "tilt", show: () => shares(structure.hinges.map(({beta}) => toDegrees(beta)), "hinge"), unit: degrees}};
    out.turn = {text: "turn", moves: true, show: () => shares(structure.hinges.map(({a, b}) => toDegrees(KinetixScene.turnBetween(this.scene.poses, a, b))), "hinge"), unit: degrees};
    const off = list(dictionary(raw[this.data.kind?.name]).body_mm).map(finite);
    if (off.length === structure.bodies.length) out.error = {text: "distance from goal", show: () => shares(off, "body"), unit: millimetres};
    const energies = list(dictionary(raw.equilibrium).hinge_energy_Nmm).map((one) => (finite(one?.stretch) ?? 0) + (finite(one?.turn) ?? 0));
    if (energies.length === structure.hinges.length && energies.some((value) => value > 0)) out.strain = {text: "energy in hinges", show: () => shares(energies, "hinge"), unit: (v) => `${figures(v, 2)} N mm`};
    return out;
  }

  paint() {
    const choice = this.choices[this.select?.value];
    if (!choice) return this.scene.setHeat(null), this.key && (this.key.textContent = "");
    const {values, of, most} = choice.show();
    this.scene.setHeat(values, of);
    this.key.textContent = `pale: 0, dark: ${choice.unit(most)}`;
  }

  show(theta) {
    this.theta = theta;
    this.scene.goal.visible = Math.abs(theta - this.motion.to) < NEAR_GOAL;
    this.scene.show(this.motion.poses(theta));
    if (this.choices?.[this.select?.value]?.moves) this.paint();
    if (this.slider) this.slider.value = theta;
    if (this.readout) this.readout.textContent = this.describePlace();
  }

  describePlace() {
    const {to, at, ofDrive} = this.motion, isEnd = Math.abs(this.theta - to) < 1e-9;
    return `${ofDrive && !isEnd ? "drive at " : ""}${degrees(toDegrees(isEnd ? at : this.theta))}`;
  }

  showPhysics(on) {
    if (this.slider) this.slider.disabled = on;
    if (!on) return this.show(this.theta);
    this.scene.goal.visible = false;
    this.scene.show(numbersOf(this.data.states.physics));
  }

  play(on) {
    this.playing = on;
    this.button.textContent = on ? "Stop" : "Play";
    const {from, to} = this.motion, share = Math.max(0, Math.min(1, (this.theta - from) / (to - from || 1)));
    const start = performance.now() - (1000 * PLAY_S * Math.acos(1 - 2 * share)) / (2 * Math.PI);
    const tick = (now) => {
      if (!this.playing) return;
      this.show(from + (to - from) * 0.5 * (1 - Math.cos((2 * Math.PI * (now - start)) / (1000 * PLAY_S))));
      requestAnimationFrame(tick);
    };
    if (on) requestAnimationFrame(tick);
  }

  buttons() {
    const button = (text, click) => html("button", {type: "button", click}, text);
    const views = ["top", "front", "side", "slant"].map((name) => button(name[0].toUpperCase() + name.slice(1), () => this.scene.orbit.view(name)));
    const picture = button("Picture", async () => KinetixScene.saveAs(await this.scene.picture(), `${this.data.name}.png`));
    const full = button("Full screen", () => (document.fullscreenElement ? document.exitFullscreen() : this.stage.requestFullscreen?.())?.catch(() => {}));
    const film = KinetixScene.canRecord(this.canvas) ? html("button", {type: "button"}) : null;
    if (film) KinetixScene.listenForFilm(film, () => this.scene, () => this.data.name, problem);
    return html("div", {class: "buttons"}, views, button("Fit", () => this.scene.fit()), full, picture, film);
  }

  controls() {
    const {from, to} = this.motion, moves = Math.abs(to - from) > 1e-9;
    if (moves) {
      const steps = {min: Math.min(from, to), max: Math.max(from, to), step: "any", value: this.theta};
      this.slider = html("input", {type: "range", ...steps, "aria-label": "Fold angle", ...(to < from ? {dir: "rtl"} : {}), input: () => this.show(Number(this.slider.value))});
      this.readout = html("output", {}, this.describePlace());
      this.button = html("button", {type: "button", click: () => this.play(!this.playing)}, "Play");
    }
    const [start, end] = this.data.structure.isBodies ? ["at rest", "moved "] : ["flat", "folded "];
    const fold = moves ? html("label", {class: "slider"}, start, this.slider, end, this.readout) : null;
    const physics = this.data.states.physics ? html("fieldset", {}, choice("source", "model", true, () => this.showPhysics(false)),
        choice("source", "simulation", false, () => this.showPhysics(true))) : null;
    this.choices = this.colours();
    this.select = html("select", {class: "colours", change: () => this.paint()}, html("option", {value: ""}, "plain"),
        Object.entries(this.choices).map(([name, {text}]) => html("option", {value: name}, text)));
    this.key = html("output", {class: "heat-key"});
    this.named = html("output", {class: "named", "aria-live": "polite"});
    return html("div", {class: "controls"}, physics, this.button, fold, html("label", {}, "colour ", this.select), this.key, this.buttons(), this.named);
  }
}

function sceneSection(data) {
  const view = new SceneView(data), controls = view.controls();
  const box = responsive(() => {
    if (view.made) view.fitInPlace();
    return view.stage;
  });
  return [controls, box, html("p", {class: "note on-screen"}, `Drag to turn it; on a phone, drag sideways. Ctrl and wheel, or two fingers, zoom. ${view.motion.words}`)];
}
