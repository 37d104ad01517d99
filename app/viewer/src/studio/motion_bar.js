// Mode, fold slider, play button, and controls of the simulation.
import {$, degrees, neat, radians, show} from "./dom.js";
import {status} from "./messages.js";

const PERIOD_S = 5;  // forward and back by the play button

export class MotionBar {
  constructor(state) {
    Object.assign(this, {state, connection: state.connection});
    for (const input of document.querySelectorAll('input[name="mode"]')) input.addEventListener("change", () => this.setMode(input.value));
    $("theta").addEventListener("input", () => this.fold(Number($("theta").value)));
    $("play").addEventListener("click", () => this.play(!this.playing));
    this.listen();
    state.on("program", () => this.showProgram());
    state.on("design", () => this.showDesign());
    state.on("frame", () => this.showFrame());
  }

  listen() {
    const {connection} = this, send = (type, keys) => connection.send(type, keys).catch(() => {});
    $("pause").addEventListener("click", () => send("pause", {on: !this.state.program.paused}));
    $("step").addEventListener("click", () => send("step"));
    $("gravity").addEventListener("change", () => send("gravity", {on: $("gravity").checked}));
    $("springs").addEventListener("change", () => send("springs", {on: $("springs").checked}));
    $("speed").addEventListener("change", () => send("speed", {factor: Number($("speed").value)}));
    $("snap").addEventListener("click", () => send("snap"));
    $("reset").addEventListener("click", () => this.play(false) ?? send("reset"));
  }

  setMode(mode) {
    this.play(false);
    const asked = this.connection.send("mode", {mode}).catch(() => this.showProgram());
    if (!this.state.design?.bodies || mode === "exact") return asked;
    status("bodies are cut into convex pieces, which collide\u2026");
    return asked.then(() => status(""));
  }

  /** Returns the slider's angle per theta. The slider shows theta, or the turn of the driven hinge of bodies. */
  get perTheta() {
    return this.state.design?.bodies?.turn_per_theta ?? 1;
  }

  fold(deg) {
    this.asked = performance.now();
    this.connection.latest("theta", {deg: deg / this.perTheta});
    this.label(deg);
  }

  label(deg) {
    $("theta").setAttribute("aria-valuetext", `${neat(deg, 1)} degrees`);
  }

  play(on) {
    if (Boolean(on) === Boolean(this.playing)) return;
    this.playing = on;
    $("play").textContent = on ? "Stop" : "Play";
    $("play").setAttribute("aria-pressed", String(on));
    if (!on) return cancelAnimationFrame(this.timer);
    const {value} = $("theta"), [low, high] = this.playRange();
    const share = Math.max(0, Math.min(1, (Number(value) - low) / (high - low || 1)));
    let start = performance.now() - (1000 * PERIOD_S * Math.acos(1 - 2 * share)) / (2 * Math.PI);
    const still = window.matchMedia("(prefers-reduced-motion: reduce)").matches ? 3 : 1;
    const tick = (now) => {
      if (!this.playing) return;
      const deg = low + (high - low) * 0.5 * (1 - Math.cos((2 * Math.PI * (now - start)) / (1000 * PERIOD_S * still)));
      $("theta").value = deg;
      this.fold(deg);
      this.timer = requestAnimationFrame(tick);
    };
    this.timer = requestAnimationFrame(tick);
  }

  /** Returns the range for the play button: the slider's range, limited for bodies to the part without collisions. */
  playRange() {
    const {min, max} = $("theta"), {meets} = this.state.design?.bodies ?? {};
    return [Math.max(Number(min), ...(meets?.[0] ? [degrees(meets[0].turn_rad)] : [])), Math.min(Number(max), ...(meets?.[1] ? [degrees(meets[1].turn_rad)] : []))];
  }

  showProgram() {
    const {program} = this.state;
    for (const input of document.querySelectorAll('input[name="mode"]')) input.checked = input.value === program.mode;
    show($("live"), program.mode === "bullet");
    show($("elastic"), program.mode === "equilibrium");
    $("pause").setAttribute("aria-pressed", String(Boolean(program.paused)));
    $("step").disabled = !program.paused;
    $("gravity").checked = program.gravity;
    $("springs").checked = program.springs;
    const nearest = [...$("speed").options].reduce((a, b) => (Math.abs(b.value - program.speed) < Math.abs(a.value - program.speed) ? b : a));
    $("speed").value = nearest.value;
  }

  showDesign() {
    if (this.state.design.bodies) return this.showTurns();
    const {design} = this.state, [low, high] = design.theta_range_rad ?? [0, radians(40)];
    $("theta").min = Math.max(-89, Math.ceil(10 * degrees(Math.min(0, low))) / 10) || 0;
    $("theta").max = Math.min(89, Math.floor(10 * degrees(high > 0 ? high : radians(40))) / 10);
    $("fold_low").textContent = Number($("theta").min) < 0 ? "the other way" : "flat";
    const exact = document.querySelector('input[name="mode"][value="exact"]');
    exact.disabled = !design.exact;
    exact.parentElement.title = design.exact ? "The analytic motion: no strain, no force" : "This design has no analytic motion";
    $("driven_by").textContent = design.drive ? `moved by ${design.drive}` : "";
  }

  /** Sets the slider of a design of bodies: the range of the driven hinge's turn, or of the mean turn if bodies are
   *  pulled. */
  showTurns() {
    const {design: {bodies, structure}} = this.state, [least, most] = bodies.turn_range_rad.map(degrees);
    Object.assign($("theta"), {min: Math.ceil(10 * least) / 10 || 0, max: Math.floor(10 * most) / 10, disabled: bodies.following});
    $("theta").setAttribute("aria-label", bodies.pulled ? "Mean turn of the hinges in degrees" : "Turn of the driven hinge in degrees");
    $("fold_low").textContent = `${neat(least, 0)}\u00b0`;
    $("fold_high").textContent = `${neat(most, 0)}\u00b0`;
    $("driven_by").textContent = bodies.pulled ? "pulled" : `turned at ${structure.hinges[bodies.driven].name}`;
    document.querySelector('input[name="mode"][value="exact"]').parentElement.title = "All hinges closed, from rest on: no strain, no contact";
  }

  /** Formats the force. Rigid hinges have no stiffness and therefore no force scale; neither has a dragging hand. */
  force(frame) {
    if (Number.isFinite(frame.force)) return `${neat(frame.force, 3)} N`;
    return frame.mode === "bullet" && !this.state.program.springs && !this.state.design.bodies ? "needs springs" : "\u2013";
  }

  showFrame() {
    const {frame} = this.state, deg = degrees(frame.theta) * this.perTheta;
    $("reading_theta").textContent = Number.isFinite(deg) ? `${neat(deg, 1)}\u00b0` : "\u2013";
    $("reading_force").textContent = this.force(frame);
    $("reading_energy").textContent = Number.isFinite(frame.energy) ? `${neat(frame.energy, 3)} N mm` : "\u2013";
    const busy = this.playing || document.activeElement === $("theta") && performance.now() - (this.asked ?? 0) < 800;
    if (!busy && Number.isFinite(deg)) {
      $("theta").value = deg;
      this.label(deg);
    }
  }
}
