// Chart of the equilibrium path from flat: force and energy over theta, with a mark at the present state.
import {$, degrees, neat, show, svg} from "./dom.js";

const WIDTH = 250, HEIGHT = 120, LEFT = 8, TOP = 20, BOTTOM = 18;  // CSS pixels

export class PathChart {
  constructor(state) {
    this.state = state;
    state.on("path", () => this.draw());
    state.on("program", () => this.draw());
    state.on("design", () => {
      if (state.path?.revision !== state.design.revision) state.path = null;
      this.draw();
    });
    state.on("frame", () => this.mark());
  }

  draw() {
    const rows = (this.state.path?.rows ?? []).filter((row) => Number.isFinite(row.force_N) && Number.isFinite(row.energy_Nmm));
    show($("path"), this.state.program.mode === "equilibrium" && rows.length > 1);
    if (rows.length < 2) return;
    const thetas = rows.map((row) => row.theta_rad), low = Math.min(0, ...thetas), high = Math.max(0, ...thetas);
    this.x = (theta) => LEFT + ((WIDTH - 2 * LEFT) * (theta - low)) / (high - low || 1);
    const line = (key, name) => {
      const values = rows.map((row) => row[key]), least = Math.min(0, ...values), most = Math.max(...values, least + 1e-9);
      const y = (value) => HEIGHT - BOTTOM - ((HEIGHT - TOP - BOTTOM) * (value - least)) / (most - least);
      return svg("path", {class: name, d: `M${rows.map((row) => `${this.x(row.theta_rad).toFixed(1)},${y(row[key]).toFixed(1)}`).join("L")}`});
    };
    const perTheta = this.state.design.bodies?.turn_per_theta ?? 1, angle = (theta) => `${neat(degrees(theta) * perTheta, 0)}\u00b0`;
    const last = rows[rows.length - 1], text = (x, y, name, words) => svg("text", {x, y, class: name}, words);
    this.now = svg("line", {class: "now", y1: TOP - 4, y2: HEIGHT - BOTTOM});
    $("path").replaceChildren(svg("svg", {viewBox: `0 0 ${WIDTH} ${HEIGHT}`, width: WIDTH, height: HEIGHT, role: "img", "aria-label":
        `Force and energy from flat, up to ${neat(Math.max(...rows.map((row) => row.force_N)))} N and ${neat(last.energy_Nmm)} N mm`},
      line("energy_Nmm", "energy"), line("force_N", "force"), this.now,
      text(LEFT, 13, "force", `force, up to ${neat(Math.max(...rows.map((row) => row.force_N)), 2)} N`),
      text(LEFT + 132, 13, "energy", `energy ${neat(last.energy_Nmm, 1)} N mm`),
      text(LEFT, HEIGHT - 4, "axis", angle(low)), text(WIDTH - LEFT - 26, HEIGHT - 4, "axis", angle(high))));
    this.mark();
  }

  mark() {
    const theta = this.state.frame?.theta;
    if (!this.now || !Number.isFinite(theta)) return;
    for (const end of ["x1", "x2"]) this.now.setAttribute(end, Math.max(0, Math.min(WIDTH, this.x(theta))));
  }
}
