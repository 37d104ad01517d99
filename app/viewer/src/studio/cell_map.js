// Flat sheet from above: cells to paint, hinges to choose. The picture is one element, and arrow keys move a mark over
// it.
import {cellAt} from "../squares.js";
import {$, show, svg} from "./dom.js";
import {status} from "./messages.js";

const CLICK_SHARE = 0.08;  // of a cell: a smaller movement is a click
const T_RANGE = [0.02, 0.98];
const MOST_HINGES = 3000;  // drawn one by one; larger sheets show only their cells

export class CellMap {
  constructor(state, box) {
    Object.assign(this, {state, box, cursor: [1, 1]});
    state.on("design", () => this.draw());
    state.on("chosen", () => this.mark());
    new ResizeObserver(() => this.sendWidth()).observe(box);
    box.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"]) box.addEventListener(end, (event) => this.lift(event, end === "pointerup"));
  }

  get symmetry() {
    return $("symmetry").value;
  }

  /** Converts a place on the page to cells of the picture. */
  at(event) {
    const {x, y} = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.picture.getScreenCTM().inverse());
    return [x, y];
  }

  /** Starts dragging the hinge under the pointer along and across its wall, or painting cells. */
  press(event, what) {
    if (event.button !== 0) return;
    event.preventDefault();
    this.picture.focus();
    this.held = {...what, start: this.at(event), adds: event.ctrlKey || event.metaKey || event.shiftKey, moved: false};
    if (what.cell) this.held.on = !this.there.has(String(what.cell)), this.held.cells = [], this.stroke(what.cell);
    this.box.setPointerCapture(event.pointerId);
  }

  stroke(cell) {
    const {cells, on} = this.held;
    if (this.there.has(String(cell)) === on || cells.some((one) => String(one) === String(cell))) return;
    cells.push(cell);
    this.rects.get(String(cell))?.classList.toggle("off", !on);
  }

  move(event) {
    if (!this.held) return;
    const [x, y] = this.at(event), [x0, y0] = this.held.start;
    this.held.moved ||= Math.hypot(x - x0, y - y0) > CLICK_SHARE;
    if (this.held.cell) return this.rects.has(String([Math.floor(x), Math.floor(this.flip - y)])) && this.stroke([Math.floor(x), Math.floor(this.flip - y)]);
    if (!this.held.moved) return;
    this.held.to = this.onWall(this.held.hinge, [x, y]);
    this.spots[this.held.hinge].setAttribute("cx", this.held.to.at[0]);
    this.spots[this.held.hinge].setAttribute("cy", this.held.to.at[1]);
  }

  lift(event, takes) {
    const {held} = this;
    this.held = null;
    if (!held) return;
    if (!takes) return this.draw();
    if (held.cell) return this.paintAll(held.cells, held.on);
    if (!held.moved) return this.choose(held.hinge, held.adds);
    const {chosen} = this.state, together = chosen.length > 1 && chosen.includes(held.hinge);
    if (!together) this.choose(held.hinge, false);
    const hinges = together ? {indices: [held.hinge, ...chosen.filter((k) => k !== held.hinge)], alternate: $("alternate").checked} : {index: held.hinge};
    this.send("hinge", {...hinges, t: held.to.t, offset_mm: held.to.offset_mm},
      `hinge ${held.hinge}: t ${held.to.t.toFixed(2)}, ${held.to.offset_mm.toFixed(2)} mm off its wall`);
  }

  /** Projects a place to a hinge's wall: t along it, offset in mm across it, and the place in the picture. */
  onWall(hinge, [x, y]) {
    const {structure} = this.state.design, edge = structure.cell_mm, [a, b] = structure.hinges[hinge].bodies.map((k) => structure.bodies[k].position_mm);
    const along = [b[0] - a[0], b[1] - a[1]], length = Math.hypot(...along), e = along.map((v) => v / length);
    const p = [x * edge - a[0], (this.flip - y) * edge - a[1]], near = Math.max(edge * 0.001, 0.04 * edge);
    const t = Math.max(T_RANGE[0], Math.min(T_RANGE[1], (p[0] * e[0] + p[1] * e[1]) / length)), off = p[1] * e[0] - p[0] * e[1];
    const offset_mm = Math.abs(off) < near ? 0 : Math.max(-0.45 * edge, Math.min(0.45 * edge, off));
    const at = [a[0] + t * along[0] - offset_mm * e[1], a[1] + t * along[1] + offset_mm * e[0]];
    return {t, offset_mm, at: [at[0] / edge, this.flip - at[1] / edge]};
  }

  /** @param words shown when it is done */
  send(type, keys, words) {
    this.state.connection.send(type, {...keys, symmetry: this.symmetry}).then(() => status(words), () => this.draw());
  }

  paintAll(cells, on) {
    if (!cells.length) return;
    this.send("paint", cells.length > 1 ? {cells: cells.flat(), on} : {cell: cells[0], on},
      `${cells.length > 1 ? `${cells.length} cells` : `cell ${cells[0].join(", ")}`} ${on ? "added" : "taken away"}`);
  }

  /** Lists the cells, and the ring of places around them for new cells. */
  places() {
    const cells = this.state.design.structure.cells.map(({cell}) => cell), there = new Set(cells.map(String));
    this.there = there;
    if (!this.state.squares) return [];
    const around = cells.flatMap(([i, j]) => [[i, j], [i + 1, j], [i - 1, j], [i, j + 1], [i, j - 1]]);
    return [...new Map(around.map((cell) => [String(cell), cell])).values()].filter(([i, j]) => i >= 0 && j >= 0);
  }

  draw() {
    if (this.state.design.bodies) return;
    const {structure, breaking = []} = this.state.design, edge = structure.cell_mm;
    const xs = structure.bodies.map(({position_mm}) => position_mm[0] / edge), ys = structure.bodies.map(({position_mm}) => position_mm[1] / edge);
    const low = [Math.min(...xs), Math.min(...ys)], high = [Math.max(...xs), Math.max(...ys)];
    const flat = ([x, y]) => [x / edge, high[1] + low[1] - y / edge];
    this.flip = high[1] + low[1];
    this.high = high;
    const bad = new Set(breaking), many = structure.hinges.length > MOST_HINGES;
    const places = this.places(), cells = places.map((cell) => this.cell(cell));
    this.rects = new Map(places.map((cell, k) => [String(cell), cells[k]]));
    const walls = structure.hinges.map(({bodies: [a, b]}) => {
      const [x1, y1] = flat(structure.bodies[a].position_mm), [x2, y2] = flat(structure.bodies[b].position_mm);
      return svg("line", {class: "wall", x1, y1, x2, y2});
    });
    this.spots = many ? [] : structure.hinges.map((hinge, index) => this.spot(hinge, index, flat(hinge.point_mm), bad));
    this.mover = svg("rect", {class: "cursor", width: 0.4, height: 0.4, rx: 0.08});
    const margin = 0.75, view = [low[0] - margin, low[1] - margin, high[0] - low[0] + 2 * margin, high[1] - low[1] + 2 * margin];
    const picture = svg("svg", {viewBox: view.join(" "), tabindex: 0, role: "application", "aria-label":
        "The flat sheet. Arrow keys move a mark over cells and hinges; Enter or Space takes what is under it.", keydown: (event) => this.key(event)},
      cells, walls, this.spots, this.mover);
    picture.style.aspectRatio = `${view[2]} / ${view[3]}`;
    if (view[2] > 3 * view[3]) picture.style.minWidth = `${Math.min(1400, 22 * view[2])}px`;
    const hadFocus = this.box.contains(document.activeElement);
    this.picture = picture;
    this.box.replaceChildren(picture);
    if (hadFocus) picture.focus();
    this.sendWidth();
    this.mark();
    this.moveCursor(0, 0, false);
  }

  /** Reports a picture that is wider than its box, because some systems hide scroll bars. */
  sendWidth() {
    show($("map_wide"), this.box.clientWidth > 0 && this.box.scrollWidth > this.box.clientWidth + 1);
  }

  cell([i, j]) {
    const on = this.there.has(String([i, j]));
    return svg("rect", {class: on ? "cell" : "cell off", x: i + 0.06, y: this.flip - j - 0.94, width: 0.88, height: 0.88, rx: 0.06,
      pointerdown: (event) => this.press(event, {cell: [i, j]})}, svg("title", {}, on ? `cell ${i}, ${j}: click to take it away` : `add cell ${i}, ${j}`));
  }

  spot(hinge, index, [cx, cy], bad) {
    const lean = hinge.beta_rad > 1e-6 ? " up" : hinge.beta_rad < -1e-6 ? " down" : "";
    return svg("circle", {class: `hinge${lean}${bad.has(index) ? " bad" : ""}`, cx, cy, r: 0.13, pointerdown: (event) => this.press(event, {hinge: index})},
      svg("title", {}, `hinge ${index}: tilt ${((hinge.beta_rad * 180) / Math.PI).toFixed(1)} degrees${bad.has(index) ? ", breaks the motion" : ""}`));
  }

  paint(cell) {
    if (!this.state.squares) return;
    this.paintAll([cell], !this.there.has(String(cell)));
  }

  choose(index, adds) {
    const {chosen} = this.state;
    this.state.choose(!adds ? [index] : chosen.includes(index) ? chosen.filter((k) => k !== index) : [...chosen, index]);
  }

  mark() {
    if (!this.spots) return;
    const chosen = new Set(this.state.chosen);
    this.spots.forEach((spot, index) => spot.classList.toggle("chosen", chosen.has(index)));
  }

  /** Moves the mark in half cell edges: two odd numbers are a cell, one even number is a wall. */
  moveCursor(dx, dy, says = true) {
    const most = this.high.map((v) => Math.ceil(2 * v) + 1);
    this.cursor = this.cursor.map((v, k) => Math.max(0, Math.min(most[k], v + [dx, dy][k])));
    const [x, y] = this.cursor;
    this.mover.setAttribute("x", x / 2 - 0.2);
    this.mover.setAttribute("y", this.flip - y / 2 - 0.2);
    if (!says) return;
    this.mover.scrollIntoView({block: "nearest", inline: "nearest"});
    status(this.words());
  }

  under() {
    const [x, y] = this.cursor;
    const cell = cellAt(this.cursor);
    if (cell) return {cell};
    const {structure} = this.state.design, edge = structure.cell_mm;
    const hinge = structure.hinges.findIndex(({bodies: [a, b]}) => {
      const [p, q] = [structure.bodies[a].position_mm, structure.bodies[b].position_mm];
      return Math.abs((p[0] + q[0]) / edge - x) < 0.3 && Math.abs((p[1] + q[1]) / edge - y) < 0.3;
    });
    return hinge < 0 ? {} : {hinge};
  }

  words() {
    const {cell, hinge} = this.under();
    if (cell) return `cell ${cell.join(", ")}: ${this.there.has(String(cell)) ? "there" : "empty"}`;
    return hinge === undefined ? "a corner" : `hinge ${hinge}`;
  }

  key(event) {
    const way = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
    if (way) this.moveCursor(...way);
    else if (event.key === "Enter" || event.key === " ") {
      const {cell, hinge} = this.under();
      if (cell) this.paint(cell);
      else if (hinge !== undefined) this.choose(hinge, event.shiftKey);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
