// Reads the result for the sections. Every key is optional; a missing key is not an error.

function list(value) {
  return Array.isArray(value) ? value : [];
}

function someDictionary(value) {
  return value && typeof value === "object" && !Array.isArray(value) ? value : null;
}

function dictionary(value) {
  return someDictionary(value) ?? {};
}

/** Returns the rows that start with `length` numbers; other rows are dropped. */
function numberRows(value, length) {
  return list(value).filter(
      (row) => list(row).length >= length && row.slice(0, length).every((v) => finite(v) !== null));
}

/** Reads a body. Its vertex is [i, j] in a lattice of squares and [number] in any other. */
function readBody(raw) {
  const vertex = list(raw?.vertex), [i = 0, j = 0] = vertex;
  return {i, j, isSquare: vertex.length === 2, number: i, name: raw?.name, rest: numberRows([raw?.position_mm], 3)[0] ?? null};
}

function readHinge(raw, bodies) {
  const [a, b] = list(raw?.bodies);
  const from = bodies[a], to = bodies[b];
  if (!from?.rest || !to?.rest) return null;
  const along = !from.isSquare ? null : from.j === to.j ? "x" : "y";
  const t = finite(raw.t) ?? 0.5;
  const point = numberRows([raw.point_mm], 3)[0] ?? mix(from.rest, to.rest, t);
  const axis = numberRows([raw.axis], 3)[0] ?? null;
  return {
    a,
    b,
    name: raw.name,
    ends: [from.number, to.number],
    across: numberRows([raw.along], 3)[0] ?? null,
    along,
    t,
    point,
    axis,
    beta: finite(raw.beta_rad) ?? 0,
    offset: finite(raw.offset_mm) ?? 0,
    alpha: finite(raw.alpha_rad) ?? Math.PI / 2,
    column: Math.min(from.i, to.i),
    row: Math.min(from.j, to.j),
  };
}

/** Describes the position of a wall. */
function nameWall({name, along, column, row, ends}) {
  return name ? name : along ? `column ${column}, row ${row}, wall along ${along}` :
                 `wall from vertex ${ends[0]} to ${ends[1]}`;
}

/** Returns the first index and the count up to the last index. */
function span(first, number, indices) {
  const low = indices.reduce((a, b) => Math.min(a, b), Infinity),
        high = indices.reduce((a, b) => Math.max(a, b), -Infinity);
  return indices.length ? {["first" + first]: low, [number]: high - low + 1} :
                          {["first" + first]: 0, [number]: 0};
}

/** Reads the surfaces of imported bodies and their soft parts; null if the page has none. */
function readMeshes(raw) {
  if (!someDictionary(raw) || typeof KinetixScene === "undefined") return null;
  return {bodies: list(raw.bodies).map(KinetixScene.decoded), hinges: list(raw.hinges).map((mesh) => mesh && KinetixScene.decoded(mesh))};
}

function readStructure(raw, meshes) {
  const cell = finite(raw.cell_mm) ?? 10;
  const bodies = list(raw.bodies).map(readBody);
  const hinges = list(raw.hinges).map((hinge) => readHinge(hinge, bodies)).filter(Boolean);
  const wall = dictionary(raw.wall_mm);
  const columns = hinges.filter((h) => h.along === "x").map((h) => h.column);
  const rows = hinges.filter((h) => h.along === "y").map((h) => h.row);
  return {
    cell,
    lattice: raw.lattice ?? "square",
    cells: list(raw.cells).length,
    isSquare: bodies.every((body) => body.isSquare),
    isBodies: bodies.some((body) => body.name),
    meshes: readMeshes(meshes),
    bodies,
    hinges,
    ...span("Column", "columns", columns),
    ...span("Row", "rows", rows),
    thickness: finite(wall.thickness) ?? 0.08 * cell,
    height: finite(wall.height) ?? 0.6 * cell,
    wallAssumed: finite(wall.thickness) === null || finite(wall.height) === null,
  };
}

/** Reads a pose: an object of result.json, or a row of seven numbers of the page. */
function readPose(raw) {
  if (Array.isArray(raw)) return numberRows([raw], 7).length ? {p: raw.slice(0, 3), q: raw.slice(3, 7)} : null;
  const p = numberRows([raw?.position_mm], 3)[0];
  const q = numberRows([raw?.quaternion_wxyz], 4)[0];
  return p && q ? {p, q} : null;
}

/** Reads a state; null unless it has one valid pose per body. */
function readState(raw, structure) {
  const poses = list(raw?.rows ?? raw?.poses).map(readPose);
  const sound = poses.length > 0 && poses.length === structure.bodies.length && poses.every(Boolean);
  return sound ? {name: raw.name, model: raw.model, theta: finite(raw.theta_rad), poses} : null;
}

function restState(structure) {
  const poses = structure.bodies.map((body) => ({p: body.rest, q: [1, 0, 0, 0]}));
  const sound = poses.length > 0 && poses.every((pose) => pose.p);
  return sound ? {name: "flat", model: "rest", theta: 0, poses} : null;
}

function readStates(raw, structure) {
  const states = list(raw).map((state) => readState(state, structure)).filter(Boolean);
  const final = states.filter((state) => state.name !== "frame");
  return {
    flat: restState(structure),
    model: final.find((state) => state.model !== "bullet") ?? null,
    physics: final.find((state) => state.model === "bullet") ?? null,
    frames: states.filter((state) => state.name === "frame" && state.theta !== null)
                .sort((a, b) => a.theta - b.theta),
  };
}

function readRun(raw, index) {
  let best = Infinity;
  const history = numberRows(raw?.history, 2).map(([at, cost]) => [at, (best = Math.min(best, cost))]);
  return {start: finite(raw?.start) ?? index, status: raw?.status, rms: finite(raw?.fit_rms), history};
}

/** Reads `verdict`: flags (null if the run did not request the check), errors and warnings. */
function readVerdict(raw) {
  const given = dictionary(raw.verdict), flag = (name) => (typeof given[name] === "boolean" ? given[name] : null);
  const problems = list(given.problems).filter((problem) => typeof problem?.text === "string");
  const texts = (level) => problems.filter((problem) => problem.level === level).map(({text}) => text);
  return {met: flag("met"), verified: flag("agrees"), printable: flag("printable"), reaches: flag("reaches"),
    errors: texts("error"), warnings: texts("warning")};
}

/** Reads the print tolerance analysis; null without one. */
function readPrintTolerance(raw) {
  if (!raw || finite(raw.p95_mm) === null) return null;
  const sources = list(raw.sources).filter((source) => finite(source?.share) !== null);
  return {process: String(raw.process), rms: raw.rms_mm, designed: raw.designed_mm, p95: raw.p95_mm, tolerance: raw.tolerance_mm, holds: raw.holds === true,
    touching: finite(raw.touching_share), mayTouch: raw.free_of_contact === false, isUnproven: raw.free_of_contact === null,
    canBePrinted: raw.can_be_printed !== false, confirmed: raw.confirmed !== false, prints: dictionary(raw.prints), play: someDictionary(raw.play), taken: someDictionary(raw.taken), sources,
    places: list(raw.places).filter((place) => finite(place?.share) !== null)};
}

/** Reads the slicer's estimate for the print; null before an export. */
function readPrint(raw) {
  if (!someDictionary(raw) || finite(raw.seconds) === null || finite(raw.material_mm3) === null) return null;
  return {process: String(raw.process), hinges: String(raw.hinges), seconds: raw.seconds, material: raw.material_mm3, prints: finite(raw.prints) ?? 1};
}

/** Reads the compensation for elastic hinges of a goal that was met exactly; null without elastic hinges. */
function readCompensation(raw) {
  if (!raw || typeof raw !== "object") return null;
  return {before: finite(raw.before_mm), after: finite(raw.after_mm), tolerance: finite(raw.tolerance_mm),
    change: toDegrees(raw.largest_change_rad), why: typeof raw.why === "string" ? raw.why : ""};
}

/** Returns the kind of goal of the search; null for a design. Results without a kind belong to the first one. */
function kindOf(raw) {
  return GOALS.find(({name}) => raw[name]) ?? (raw.target ? GOALS[0] : null);
}

/** Returns the best view of the folded shape: from the goal, else from the family of the design. */
function viewFor(kind, raw, equilibrium) {
  if (kind) return kind.view;
  const {family} = dictionary(raw.plan);
  if (family === "F1" || family === "planar" || equilibrium?.planar) return "top";
  return family !== "none" ? "side" : "slant";
}

function readResult(raw) {
  const structure = readStructure(dictionary(raw.structure), raw.meshes);
  const metrics = dictionary(raw.metrics), tolerance = dictionary(raw.tolerance);
  const optimiser = dictionary(raw.optimiser), equilibrium = readEquilibrium(raw.equilibrium);
  const kind = kindOf(raw), states = readStates(raw.states, structure);
  return {
    raw,
    kind,
    goal: kind?.read(raw) ?? null,
    structure,
    metrics,
    tolerance,
    optimiser,
    name: typeof raw.name === "string" && raw.name ? raw.name : "Unnamed result",
    view: viewFor(kind, raw, equilibrium),
    equilibrium,
    stable: readStable(raw.equilibrium, structure),
    states: kind?.place?.(raw, states) ?? states,
    verdict: readVerdict(raw),
    title: typeof dictionary(raw.summary).title === "string" ? raw.summary.title : "computed",
    summary: list(dictionary(raw.summary).lines).filter((line) => typeof line?.label === "string" && typeof line.text === "string"),
    printTolerance: readPrintTolerance(raw.as_made),
    certified: readCertified(raw.certified),
    print: readPrint(raw.print),
    card: raw.card ? {pictures: list(raw.card.pictures), steps: list(raw.card.steps)} : null,
    robustChoices: readRobustChoices(raw.robust),
    matter: readCompensation(raw.matter),
    runs: list(optimiser.runs).map(readRun),
    fidelity: list(raw.fidelity).filter((entry) => entry && typeof entry === "object"),
    timing: dictionary(raw.timing_s),
    plan: dictionary(raw.plan),
    physics: dictionary(raw.physics),
  };
}
