// The sheet from above, flat: cells to paint, hinges to choose. One picture that the arrow keys walk over.
import {status, svg} from "./dom.js";

const MOST_HINGES = 3000;  // drawn one by one; larger sheets show their cells alone

export class CellMap {
  constructor(state, box) {
    Object.assign(this, {state, box, cursor: [1, 1]});
    state.on("design", () => this.draw());
    state.on("chosen", () => this.mark());
  }

  /** Cells there are, and one ring of places around where there could be more. */
  places() {
    const cells = this.state.design.structure.cells.map(({cell}) => cell), there = new Set(cells.map(String));
    this.there = there;
    if (!this.state.squares) return [];
    const around = cells.flatMap(([i, j]) => [[i, j], [i + 1, j], [i - 1, j], [i, j + 1], [i, j - 1]]);
    return [...new Map(around.map((cell) => [String(cell), cell])).values()].filter(([i, j]) => i >= 0 && j >= 0);
  }

  draw() {
    const {structure, breaking = []} = this.state.design, edge = structure.cell_mm;
    const xs = structure.bodies.map(({position_mm}) => position_mm[0] / edge), ys = structure.bodies.map(({position_mm}) => position_mm[1] / edge);
    const low = [Math.min(...xs), Math.min(...ys)], high = [Math.max(...xs), Math.max(...ys)];
    const flat = ([x, y]) => [x / edge, high[1] + low[1] - y / edge];
    this.flip = high[1] + low[1];
    this.high = high;
    const bad = new Set(breaking), many = structure.hinges.length > MOST_HINGES;
    const cells = this.places().map((cell) => this.cell(cell));
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
    this.box.replaceChildren(picture);
    if (hadFocus) picture.focus();
    this.mark();
    this.moveCursor(0, 0, false);
  }

  cell([i, j]) {
    const on = this.there.has(String([i, j]));
    return svg("rect", {class: on ? "cell" : "cell off", x: i + 0.06, y: this.flip - j - 0.94, width: 0.88, height: 0.88, rx: 0.06,
      click: () => this.paint([i, j])}, svg("title", {}, on ? `cell ${i}, ${j}: click to take it away` : `add cell ${i}, ${j}`));
  }

  spot(hinge, index, [cx, cy], bad) {
    const lean = hinge.beta_rad > 1e-6 ? " up" : hinge.beta_rad < -1e-6 ? " down" : "";
    return svg("circle", {class: `hinge${lean}${bad.has(index) ? " bad" : ""}`, cx, cy, r: 0.13, click: (event) => this.choose(index, event.ctrlKey || event.metaKey || event.shiftKey)},
      svg("title", {}, `hinge ${index}: tilt ${((hinge.beta_rad * 180) / Math.PI).toFixed(1)} degrees${bad.has(index) ? ", breaks the motion" : ""}`));
  }

  paint(cell) {
    if (!this.state.squares) return;
    const on = !this.there.has(String(cell));
    this.state.connection.send("paint", {cell, on}).catch(() => {});
    status(`cell ${cell.join(", ")} ${on ? "added" : "taken away"}`);
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

  /** The mark stands at half cell edges: odd, odd is a cell, one of them even a wall. */
  moveCursor(dx, dy, says = true) {
    const most = this.high.map((v) => Math.ceil(2 * v) + 1);
    this.cursor = this.cursor.map((v, k) => Math.max(0, Math.min(most[k], v + [dx, dy][k])));
    const [x, y] = this.cursor;
    this.mover.setAttribute("x", x / 2 - 0.2);
    this.mover.setAttribute("y", this.flip - y / 2 - 0.2);
    if (says) status(this.words());
  }

  under() {
    const [x, y] = this.cursor;
    if (x % 2 && y % 2) return {cell: [(x - 1) / 2, (y - 1) / 2]};
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
