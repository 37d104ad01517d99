// Helmet: distance from the head and tilts by cell on the flat fishbone, the side view, and the ribs.

function readHelmet(raw) {
  if (!raw || typeof raw !== "object") return null;
  const words = (texts) => list(texts).filter((text) => typeof text === "string");
  const numbers = (values) => list(values).map(finite);
  return {
    clearance: finite(raw.clearance_mm), coverage: finite(raw.coverage_mm), trimmed: finite(raw.cells_trimmed) ?? 0,
    ribs: list(raw.ribs).map((rib) => ({row: finite(rib?.row), cells: numberRows([rib?.cells], 2)[0] ?? [0, 0], rms: finite(rib?.rms_mm)})),
    error: dictionary(raw.error), physics: raw.physics ? dictionary(raw.physics) : null, cells: numbers(raw.cell_mm),
    backdrop: headLines(raw, raw.head_mm), bare: headLines(raw, raw.bare_mm), covered: finite(raw.covered_share),
    invented: typeof raw.invented === "string" ? raw.invented : "", notes: words(raw.notes), reasons: words(raw.reasons), physicsReasons: words(raw.reasons_physics),
  };
}

/** Moves states into the frame of the head, z up, whatever the up direction of the mesh file is. */
function inHeadFrame(raw, states) {
  const frame = readPose(dictionary(raw).head_frame);
  if (!frame) return states;
  const [w, ...v] = frame.q, back = [w, ...scale(v, -1)];
  const times = ([a, ...u], [b, ...x]) => [a * b - dot(u, x), ...add(add(scale(x, a), scale(u, b)), cross(u, x))];
  const moved = (state) => state && {...state, poses: state.poses.map(({p, q}) => ({p: turned(back, subtract(p, frame.p)), q: times(back, q)}))};
  return {...states, model: moved(states.model), physics: moved(states.physics), frames: states.frames.map(moved)};
}

/** Returns lines on the head in the frame of the head. */
function headLines(raw, lines) {
  const frame = readPose(dictionary(raw).head_frame) ?? {p: [0, 0, 0], q: [1, 0, 0, 0]}, [w, ...v] = frame.q;
  return list(lines).map((line) => numberRows(line, 3).map((p) => turned([w, ...scale(v, -1)], subtract(p, frame.p))));
}

function describeFit({rms_mm: rms, max_mm: most}) {
  return `${millimetres(rms)} rms, ${millimetres(most)} at worst`;
}

function describeHelmet(data) {
  const {goal: helmet} = data;
  const near = helmet.covered === null ? "" : ` ${percent(helmet.covered)} of the head are within a cell edge of a rib.`;
  const run = helmet.physics ? `In the simulation: ${describeFit(helmet.physics)}.` : describeSimulation(data);
  return `Off head plus clearance by ${describeFit(helmet.error)}.${near} ${run}${helmet.invented ? ` But ${helmet.invented}.` : ""}`;
}

/** Returns the corners of each cell, as rows of body indices. */
function cellsOf(raw) {
  return numberRows(dictionary(raw.structure).cells?.map((cell) => cell?.bodies), 4);
}

/** Returns the tilt of a cell's crease, which is the largest tilt of its walls. */
function tiltOfCell(raw, k, hinges) {
  const members = list(list(dictionary(raw.structure).cells)[k]?.hinges);
  return members.map((h) => hinges[h]?.beta ?? 0).reduce((a, b) => (Math.abs(b) > Math.abs(a) ? b : a), 0);
}

/** Draws the flat fishbone with one colour per cell. The front of the head is at the top. */
function cellMap({structure, raw}, values, most, unit, width, label) {
  const corners = cellsOf(raw), rest = (body) => structure.bodies[body].rest.slice(0, 2);
  const box = extent(corners.flat().map(rest));
  const px = Math.min((width - 4) / box.size[0], 520 / box.size[1]);
  const to = ([x, y]) => [2 + (x - box.low[0]) * px, 2 + (box.high[1] - y) * px];
  return drawing(
      box.size[0] * px + 4, box.size[1] * px + 4, label,
      corners.map((bodies, k) => svg("path", {
        d: path(bodies.map((body) => to(rest(body))), true), fill: tiltColour(values[k] ?? 0, most),
        stroke: colour("rim"), "stroke-width": 0.4
      }, svg("title", {}, unit(values[k])))));
}

function colourKey(most, unit) {
  const bar = 160, steps = 33, side = 40;  // px: room for half of a label, such as "−0.081 mm"
  return drawing(
      bar + 2 * side, 40, "Colour scale", Array.from({length: steps}, (_, k) => svg("rect", {
        x: side + (k * bar) / steps, y: 4, width: bar / steps + 0.6, height: 12, fill: tiltColour((2 * k) / (steps - 1) - 1, 1)
      })),
      svg("g", {class: "ticks"}, [-1, 0, 1].map((share) => svg("text", {x: side + (bar * (share + 1)) / 2, y: 32, "text-anchor": "middle"}, unit(share * most)))));
}

function mapFigure(data, values, most, unit, label, text) {
  return html("figure", {class: "picture"}, responsive((width) => cellMap(data, values, most, unit, width, label)), colourKey(most, unit),
              html("figcaption", {}, text));
}

function largest(values) {
  return Math.max(1e-9, ...values.map((value) => Math.abs(value ?? 0)));
}

function fitMaps(data) {
  const {goal: helmet, raw, structure} = data;
  const tilts = cellsOf(raw).map((_, k) => toDegrees(tiltOfCell(raw, k, structure.hinges)));
  return html(
      "div", {class: "groups"},
      mapFigure(data, helmet.cells, largest(helmet.cells), millimetres, "Distance by cell",
                "Distance from the clearance, by cell: brown too near, green too far. The fishbone is printed like this."),
      mapFigure(data, tilts, largest(tilts), degrees, "Tilts by cell", "Tilt of the walls that bend, by cell."));
}

function ribTable({ribs}) {
  return table(["Rib", "Row", "Cells beyond the spine", "Off its section, rms"], ribs.map((rib, k) => ({
    cells: [String(k + 1), String(rib.row), rib.cells.join(" and "), millimetres(rib.rms)]
  })), "Ribs");
}

/** Makes the table of tilts: cells of each rib from the spine outwards, and cells of the spine from back to front. */
function tiltTableOfHelmet({goal: {ribs}, raw, structure}) {
  const at = new Map(list(dictionary(raw.structure).cells).map((cell, k) => [list(cell?.cell).join(), toDegrees(tiltOfCell(raw, k, structure.hinges))]));
  const spine = ribs[0]?.cells ? [...at.keys()].map((key) => key.split(",").map(Number)) : [], inRibs = new Set(ribs.map(({row}) => row));
  const column = spine.find(([, j]) => !inRibs.has(j))?.[0];
  if (column === undefined) return null;
  const text = (value) => (value === undefined ? "" : figures(value, 3));
  const rows = [...new Set(spine.map(([i]) => i))].sort((a, b) => a - b).map((i) => ({
    mark: i === column ? "best" : null,
    cells: [i === column ? "spine" : String(i - column), ...ribs.map(({row}) => text(at.get(`${i},${row}`)))]
  }));
  const along = spine.filter(([i]) => i === column).sort((a, b) => a[1] - b[1]);
  return html(
      "details", {}, html("summary", {}, "Tilts of all cells, in degrees"),
      html("div", {class: "scroll blocks"},
           table(["cell next to the spine", ...ribs.map((_, k) => `rib ${k + 1}`)], rows, "Tilts of the ribs"),
           table(["row of the spine", "tilt"], along.map(([i, j]) => ({cells: [String(j), text(at.get(`${i},${j}`))]})), "Tilts of the spine")));
}

function helmetSection(data) {
  const {goal: helmet} = data;
  return html(
      "div", {},
      html("p", {class: "lead"},
           `${count(helmet.ribs.length, "rib", "ribs")}, ${millimetres(helmet.clearance)} over the head, down to ${millimetres(helmet.coverage)} below the crown.`),
      fitMaps(data), html("div", {class: "scroll"}, ribTable(helmet)),
      tiltTableOfHelmet(data), trueScale(data),
      helmet.notes.length ? html("ul", {class: "why"}, helmet.notes.map((note) => html("li", {}, note))) : null);
}

const helmetGoal = {
  name: "helmet",
  read: (raw) => readHelmet(raw.helmet),
  place: (raw, states) => inHeadFrame(raw.helmet, states),
  view: "slant",
  backdropKey: ["head-key", "the head"],
  describe: describeHelmet,
  numbers: (data) => measures(data, [
    ["distance_rms_mm", "Distance, rms", "mm, of the bodies from head plus clearance", "rms_mm"],
    ["distance_max_mm", "Distance, largest", "mm, of the bodies from head plus clearance", "max_mm"],
  ]),
  firstSections: [["helmet", "How it fits the head", helmetSection]],
  hasNoLayout: true,
};
