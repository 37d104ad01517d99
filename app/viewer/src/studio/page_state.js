// What the page knows: the design, the state of the program, the newest frame, what is chosen. Panels listen.

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

  /** Of a design of bodies: one body or one hinge, of which the panel tells. */
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

  /** A wall of squares: {along: "x" or "y", column, row}; null elsewhere. */
  wall(index) {
    const {structure} = this.design, ends = structure.hinges[index].bodies.map((body) => structure.bodies[body].vertex);
    if (ends.some((vertex) => vertex?.length !== 2)) return null;
    const [[i, j], [k]] = ends;
    return {along: i === k ? "y" : "x", column: i, row: j};
  }
}
