// Pointer and keys on the scene: drag, fix, push, select. The camera handles all other input.
import {$} from "./dom.js";
import {showMessage, status} from "./messages.js";

const CLICK_PX = 5;        // a smaller movement is a click
const KEY_STEP = 0.25;     // of a cell edge per key press, when keys drag a body

export class DragTool {
  constructor(state, scene) {
    Object.assign(this, {state, scene, connection: state.connection, body: null, held: null, pushed: null});
    state.on("design", () => this.body >= this.state.design.structure.bodies.length && this.choose(null));
    const canvas = scene.canvas;
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.up(event));
    canvas.addEventListener("pointercancel", () => this.letGo());
  }

  get tool() {
    return document.querySelector('input[name="tool"]:checked').value;
  }

  /** Returns whether a pointer press belongs to a tool instead of the camera. */
  takes(event) {
    if (event.button !== 0) return false;
    const wants = event.shiftKey ? "drag" : this.tool;
    return (wants === "drag" || wants === "push") && this.scene.pick(event.clientX, event.clientY) !== null;
  }

  down(event) {
    this.start = [event.clientX, event.clientY];
    const tool = event.shiftKey ? "drag" : this.tool;
    if (event.button !== 0 || (tool !== "drag" && tool !== "push")) return;
    const found = this.scene.pick(event.clientX, event.clientY);
    if (!found) return;
    this.scene.canvas.setPointerCapture(event.pointerId);
    this.held = {...found, tool, pointer: event.pointerId};
    this.choose(found.body);
    if (tool === "push") this.push(found);
  }

  async push({body, at}) {
    if (!(await this.inPhysics("Pushing"))) return;
    const force = Number($("push_force").value) || 1;
    this.pushed = body;
    this.connection.send("push", {body, at, force_N: force})
      .then(() => this.pushed === body && status(`pushing body ${body} with ${force} N`, () => this.pushed === body), () => {});
  }

  move(event) {
    if (!this.held || this.held.pointer !== event.pointerId || this.held.tool !== "drag") return;
    const to = this.scene.facing(event.clientX, event.clientY, this.held.point);
    this.held.to = to;
    this.connection.latest("drag", {body: this.held.body, at: this.held.at, to});
    this.thread();
  }

  thread() {
    if (this.held?.to) this.scene.setThread(this.scene.carried(this.held.body, this.held.at), this.held.to);
    else this.scene.setThread(null);
  }

  up(event) {
    const moved = this.start && Math.hypot(event.clientX - this.start[0], event.clientY - this.start[1]) > CLICK_PX;
    if (this.held) this.letGo();
    if (event.button === 0 && this.start && !moved) this.click(event);
    this.start = null;
  }

  /** Ends a drag or push. Depending on the mode, the object stays in place or springs back. */
  letGo() {
    this.held = null;
    if (this.pushed !== null) status("");
    this.pushed = null;
    this.scene.setThread(null);
    this.connection.forget("drag");
    return this.connection.send("release").catch(() => {});
  }

  click(event) {
    const found = this.scene.pick(event.clientX, event.clientY);
    if (this.tool === "fix" && found) return this.fix(found.body);
    if (this.tool !== "select" && this.tool !== "turn") return;
    if (this.state.design.bodies) return this.chooseThing(found);
    if (!found) return this.state.choose([]);
    this.choose(found.body);
    const add = event.ctrlKey || event.metaKey, {chosen} = this.state;
    this.state.choose(add ? [...new Set([...chosen, found.hinge])] : [found.hinge]);
  }

  /** Chooses the soft part or the body under the pointer, in a design of bodies. */
  chooseThing(found) {
    this.body = found?.body ?? null;
    if (found?.hinge !== undefined) this.state.chooseHinge(found.hinge);
    else this.state.chooseBody(this.body);
  }

  choose(body) {
    this.body = body;
  }

  async fix(body) {
    if (!(await this.inPhysics("Fixing"))) return;
    const fixed = !this.state.program.fixed?.includes(body);
    const holds = () => Boolean(this.state.program.fixed?.includes(body)) === fixed;
    await this.connection.send("fix", {body, fixed}).then(() => status(`body ${body} is ${fixed ? "fixed" : "free"}`, holds), () => {});
  }

  /** Switches to the simulation, which these tools need. Returns whether it is active. */
  async inPhysics(what) {
    if (this.state.program.mode === "bullet") return true;
    try {
      await this.connection.send("mode", {mode: "bullet"});
      status(`Switched to Physics mode (${what} needs it)`, () => this.state.program.mode === "bullet");
      return true;
    } catch (error) {
      showMessage(error.message, {about: "mode"});
      return false;
    }
  }

  /** Handles keys: N, B choose a body; J L I K U O drag it; X fixes it. Returns whether the key was handled. */
  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return false;
    const count = this.state.design?.structure.bodies.length ?? 0, key = event.key.toLowerCase();
    if (key === "n" || key === "b") return this.nextBody(key === "n" ? 1 : -1, count);
    if (key === "x" && this.body !== null) return this.fix(this.body), true;
    const way = {j: [-1, 0, 0], l: [1, 0, 0], u: [0, 1, 0], o: [0, -1, 0], i: [0, 0, -1], k: [0, 0, 1]}[key];
    if (!way || this.body === null) return false;
    this.dragBy(key === "i" ? [0, 0, 1] : key === "k" ? [0, 0, -1] : way);
    return true;
  }

  nextBody(by, count) {
    if (!count) return false;
    this.choose(((this.body ?? (by > 0 ? -1 : count)) + by + count) % count);
    const {structure, bodies} = this.state.design;
    if (bodies) return this.state.chooseBody(this.body), status(`${structure.bodies[this.body].name}, body ${this.body} of ${count}`), true;
    const hinge = structure.hinges.findIndex(({bodies}) => bodies.includes(this.body));
    this.state.choose(hinge < 0 ? [] : [hinge]);
    status(`body ${this.body} of ${count}`);
    return true;
  }

  /** Drags the body along the axes of the shown orientation. */
  dragBy([x, y, z]) {
    const at = this.state.design.structure.bodies[this.body].position_mm, step = KEY_STEP * this.state.design.structure.cell_mm;
    if (!this.held || this.held.tool !== "keys") this.held = {body: this.body, at, tool: "keys", to: this.scene.carried(this.body, at)};
    const [a, b, c] = this.scene.held;
    this.held.to = this.held.to.map((v, k) => v + step * (x * a[k] + y * b[k] + z * c[k]));
    this.connection.latest("drag", {body: this.body, at, to: this.held.to});
    this.thread();
  }
}
