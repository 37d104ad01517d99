// State of the page: the design, the program's state, the newest frame, the choice. Panels listen for its events.

export class PageState extends EventTarget {
  constructor(connection) {
    super();
    Object.assign(this, {connection, design: null, program: {mode: "exact", fixed: []}, frame: null, chosen: [], body: null, before: null, hello: null});
  }

  changed(what) {
    this.dispatchEvent(new Event(what));
  }

  on(what, handler) {
    this.addEventListener(what, handler);
  }

  choose(hinges) {
    this.chosen = hinges;
    this.changed("chosen");
  }

  /** Chooses one body, or with chooseHinge one hinge, to show in the panel of a design of bodies. */
  chooseBody(body) {
    this.body = body;
    this.choose([]);
  }

  chooseHinge(hinge) {
    this.body = null;
    this.choose([hinge]);
  }

  get squares() {
    return this.design.structure.bodies.every(({vertex}) => vertex?.length === 2) && (this.design.structure.lattice ?? "square") === "square";
  }

  /** Returns a wall of squares: {along: "x" or "y", column, row}; null in other lattices. */
  wall(index) {
    const {structure} = this.design, ends = structure.hinges[index].bodies.map((body) => structure.bodies[body].vertex);
    if (ends.some((vertex) => vertex?.length !== 2)) return null;
    const [[i, j], [k]] = ends;
    return {along: i === k ? "y" : "x", column: i, row: j};
  }
}
