// Field for drawing a line with the pointer, or point by point with the keys. Points are in mm, y up.
import {status} from "./messages.js";

const LEAST_STEP = 0.012;  // of the field's width, between kept points
const KEY_STEP = 0.05;     // of the field's width per key press
const SMOOTHING = 3;       // passes of a weighted mean of three points, against a trembling hand

export class DrawingPad {
  /** @param done called without arguments after a change of the line */
  constructor(canvas, width_mm, done, closed = false) {
    Object.assign(this, {canvas, width_mm, done, closed, line: [], cursor: [0.2, 0.3]});
    canvas.addEventListener("pointerdown", (event) => this.start(event));
    canvas.addEventListener("pointermove", (event) => this.drawing && this.add(this.at(event)));
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => this.end());
    canvas.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.paint()).observe(canvas);
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.paint());
  }

  empty() {
    this.line = [];
    this.paint();
  }

  get points() {
    let line = this.line;
    for (let k = 0; k < SMOOTHING; ++k) line = line.map((p, n) => (n === 0 || n === line.length - 1 ? p :
      [0, 1].map((c) => (line[n - 1][c] + 2 * p[c] + line[n + 1][c]) / 4)));
    return line.map((p) => p.map((v) => v * this.width_mm));
  }

  at(event) {
    const box = this.canvas.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (box.bottom - event.clientY) / box.width];
  }

  start(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.drawing = true;
    this.line = [this.at(event)];
  }

  add(point) {
    const last = this.line[this.line.length - 1];
    if (last && Math.hypot(point[0] - last[0], point[1] - last[1]) < LEAST_STEP) return;
    this.line.push(point);
    this.paint();
  }

  end() {
    if (!this.drawing) return;
    this.drawing = false;
    this.done();
  }

  key(event) {
    const way = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
    if (way) this.cursor = this.cursor.map((v, k) => Math.max(0, Math.min(1, v + KEY_STEP * way[k])));
    else if (event.key === "Enter" || event.key === " ") this.add([...this.cursor]), this.done();
    else if (event.key === "Backspace" || event.key === "Delete") this.line.pop(), this.done();
    else return;
    event.preventDefault();
    status(`${Math.round(this.cursor[0] * this.width_mm)}, ${Math.round(this.cursor[1] * this.width_mm)} mm; ${this.line.length} points`);
    this.paint();
  }

  paint() {
    const {canvas} = this, ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
    if (!width) return;
    canvas.width = width * ratio;
    canvas.height = height * ratio;
    const context = canvas.getContext("2d"), css = (name) => getComputedStyle(canvas).getPropertyValue(name).trim();
    context.scale(ratio, ratio);
    context.lineWidth = 2.5;
    context.lineJoin = context.lineCap = "round";
    context.strokeStyle = css("--scene-goal");
    context.beginPath();
    for (const [x, y] of this.line) context.lineTo(x * width, height - y * width);
    if (this.closed && !this.drawing) context.closePath();
    context.stroke();
    context.fillStyle = css("--muted");
    context.font = "12px system-ui, sans-serif";
    context.fillText(this.line.length ? `${Math.round(this.width_mm)} mm wide` : "draw here", 10, height - 10);
    if (document.activeElement === canvas) {
      context.strokeStyle = css("--accent");
      context.strokeRect(this.cursor[0] * width - 4, height - this.cursor[1] * width - 4, 8, 8);
    }
  }
}
