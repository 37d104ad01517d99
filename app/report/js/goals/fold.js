// Fold: the flat net with its creases, their angles, and the unfoldings that were tried.

const EXACT_DEG = 5e-7;  // degrees: six decimals show smaller errors as 0

function readFold(raw) {
  if (!raw || typeof raw !== "object") return null;
  const words = (texts) => list(texts).filter((text) => typeof text === "string");
  const place = (part) => ({
    name: String(part?.name ?? ""),
    at: numberRows([part?.cell], 2)[0] ?? [0, 0],
    size: numberRows([part?.cells], 2)[0] ?? [0, 0],
    corners: numberRows(part?.corners, 2)
  });
  return {
    faces: list(raw.faces).map((face) => ({...place(face), rms: finite(face?.rms), physics: finite(face?.rms_physics)})),
    creases: list(raw.creases).map((crease) => ({
      ...place(crease), columns: finite(crease?.columns) ?? 1, asked: finite(crease?.angle_deg) ?? 0,
      model: finite(crease?.fold_deg), physics: finite(crease?.fold_physics_deg), tilt: finite(crease?.tilt_deg)
    })),
    ideal: list(raw.ideal_mm).map((line) => numberRows(line, 3)),
    edges: numberRows([raw.edges_mm], 3)[0] ?? null,
    loads: someDictionary(raw.loads), unlimited: someDictionary(raw.unlimited),
    unfoldings: finite(raw.unfoldings), unfolding: finite(raw.unfolding),
    attempts: list(raw.attempts).filter((attempt) => attempt && typeof attempt === "object"),
    reasons: words(raw.reasons), physicsReasons: words(raw.reasons_physics),
  };
}

function describeFold(creases, key) {
  const known = creases.filter((crease) => crease[key] !== null);
  const miss = Math.max(0, ...known.map((crease) => Math.abs(crease[key] - crease.asked)));
  const off = miss < EXACT_DEG ? "at" : `within ${measured(miss, "\u00b0", 6)} of`;
  return `${count(known.length, "crease", "creases")} ${off} the required angle`;
}

function describeFoldResult(data) {
  const {goal: fold, metrics} = data;
  const model = `In the model: ${describeFold(fold.creases, "model")}, faces ${percent(metrics.face_rms)} of their edge from the solid.`;
  const ran = finite(metrics.face_rms_physics) !== null;
  return `${model} ${ran ? `In the simulation: ${describeFold(fold.creases, "physics")}, faces ${percent(metrics.face_rms_physics)}.` : describeSimulation(data)}`;
}

function creaseColour(angle) {
  return colour(angle < 0 ? "tilt-minus" : angle > 0 ? "tilt-plus" : "tilt-none");
}

/** Draws the net of a solid from above. Faces and creases are polygons. */
function drawSolidNet({faces, creases}, width) {
  const box = extent([...faces, ...creases].flatMap(({corners}) => corners));
  const px = Math.min(40, (width - 4) / box.size[0], 560 / box.size[1]);
  const to = ([x, y]) => [2 + (x - box.low[0]) * px, 2 + (box.high[1] - y) * px];
  const polygon = ({corners}, fill, ...inside) => svg("path", {d: path(corners.map(to)) + "Z", fill, stroke: colour("rim"), "stroke-width": 0.6}, ...inside);
  const label = ({corners, name}) => {
    const at = to([0, 1].map((k) => corners.reduce((sum, corner) => sum + corner[k], 0) / corners.length));
    return svg("text", {x: at[0], y: at[1] + 4, "text-anchor": "middle", "font-size": 11, fill: colour("ink")}, name);
  };
  return drawing(
      box.size[0] * px + 4, box.size[1] * px + 4, "The flat net with its creases",
      faces.map((face) => polygon(face, colour("plate"))),
      creases.map((crease) => polygon(crease, creaseColour(crease.asked),
                                      svg("title", {}, `${crease.name}: ${degrees(crease.asked)}, hinges tilted by ${degrees(crease.tilt)}`))),
      faces.map(label));
}

/** Draws the net from above, with one unit per cell. */
function drawNet({faces, creases}, width) {
  if (faces.some(({corners}) => corners.length)) return drawSolidNet({faces, creases}, width);
  const box = extent([...faces, ...creases].flatMap(({at, size}) => [at, add(at, size)]));
  const px = Math.min(40, (width - 4) / box.size[0], 560 / box.size[1]);
  const place = ({at, size}) => ({
    x: (2 + (at[0] - box.low[0]) * px).toFixed(1), y: (2 + (box.high[1] - at[1] - size[1]) * px).toFixed(1),
    width: (size[0] * px).toFixed(1), height: (size[1] * px).toFixed(1)
  });
  const grid = ({at, size}) => {
    const to = (x, y) => [2 + (x - box.low[0]) * px, 2 + (box.high[1] - y) * px];
    const lines = [];
    for (let i = 0; i <= size[0]; ++i) lines.push(path([to(at[0] + i, at[1]), to(at[0] + i, at[1] + size[1])]));
    for (let j = 0; j <= size[1]; ++j) lines.push(path([to(at[0], at[1] + j), to(at[0] + size[0], at[1] + j)]));
    return svg("path", {d: lines.join(""), fill: "none", stroke: colour("rim"), "stroke-width": 0.6, opacity: 0.5});
  };
  const label = (part, text, size) => {
    const {x, y, width: w, height: h} = place(part), middle = [Number(x) + w / 2, Number(y) + h / 2];
    const upright = Number(h) > Number(w) && size < 14 ? `rotate(-90 ${middle[0]} ${middle[1]})` : null;
    return svg("text", {
      x: middle[0], y: middle[1] + size * 0.35, "text-anchor": "middle", "font-size": size, transform: upright, fill: colour("ink"),
      stroke: colour("paper"), "stroke-width": 3, "paint-order": "stroke"
    }, text);
  };
  return drawing(
      box.size[0] * px + 4, box.size[1] * px + 4, "The flat net with its creases",
      faces.map((face) => svg("rect", {...place(face), fill: colour("plate")})),
      creases.map((crease) => svg("rect", {...place(crease), fill: creaseColour(crease.asked)},
                                  svg("title", {}, `${crease.name}: ${degrees(crease.asked)}, walls tilted by ${degrees(crease.tilt)}`))),
      [...faces, ...creases].map(grid), faces.map((face) => label(face, face.name, 14)),
      creases.map((crease) => label(crease, degrees(crease.asked), 11)));
}

function creaseTable({creases}) {
  const angle = (value) => (value === null ? DASH : measured(value, "\u00b0", 6));
  return table(["Crease", "Columns", "Required", "Model", "Simulation", "Tilt of its walls"], creases.map((crease) => ({
    cells: [crease.name, String(crease.columns), angle(crease.asked), angle(crease.model), angle(crease.physics), degrees(crease.tilt)]
  })), "Creases");
}

function attemptTable({attempts}) {
  const dropped = attempts.filter((attempt) => attempt.why);
  if (!dropped.length) return null;
  return html(
      "details", {}, html("summary", {}, `${count(dropped.length, "attempt", "attempts")} that failed, with the reason`),
      table(["Unfolding", "Columns per crease", "reason"], dropped.map((attempt) => ({
        cells: [String((finite(attempt.unfolding) ?? 0) + 1), [...new Set(list(attempt.columns))].join(", "), String(attempt.why)]
      })), "Attempts"));
}

function foldLimits({loads, unlimited}) {
  if (!loads) return null;
  const row = (name, at) => ({cells: [name, degrees(toDegrees(at.theta_rad)), `${figures(at.force_N, 2)} N`, figures(at.strain, 2)]});
  const rows = [row(unlimited ? "within the limits" : "this net, within the limits", loads)];
  if (unlimited) rows.push(row("without limits", unlimited));
  return html("div", {class: "scroll"}, table(["", "fold angle", "force, largest", "strain, largest"], rows, "Limits of force and strain"));
}

function foldSection({goal: fold, structure}) {
  const edges = fold.edges ? ` The ideal solid has edges of ${fold.edges.map(millimetres).join(" \u00d7 ")}.` : "";
  return html(
      "div", {},
      html("p", {class: "lead"},
           `${count(fold.faces.length, "face", "faces")} and ${count(fold.creases.length, "crease", "creases")} of cells of ${
               millimetres(structure.cell)}, unfolding ${(fold.unfolding ?? 0) + 1} of ${fold.unfoldings ?? 1}.${edges}`),
      html("figure", {class: "picture", id: "net"}, responsive((width) => drawNet(fold, width)),
           html("figcaption", {}, "Seen from above, flat. Coloured cells bend by the angle on them. Positive angles fold towards the reader.")),
      html("div", {class: "scroll"}, creaseTable(fold)), foldLimits(fold), attemptTable(fold));
}

/** Returns three corner bodies of the first face: one, and others along x and y. Null for faces without cells. */
function bottomCorners({goal, structure: {bodies}}) {
  const face = goal?.faces[0];
  if (!face?.size[0]) return null;
  const at = (i, j) => bodies.findIndex((body) => body.i === face.at[0] + i * face.size[0] && body.j === face.at[1] + j * face.size[1]);
  const corners = [at(0, 0), at(1, 0), at(0, 1)];
  return corners.includes(-1) ? null : corners;
}

const foldGoal = {
  name: "fold",
  bottom: bottomCorners,
  read: (raw) => readFold(raw.fold),
  view: "slant",
  describe: describeFoldResult,
  numbers: (data) => measures(data, [
    ["fold_miss_deg", "Crease error, largest", "degrees", "angle_deg"],
    ["face_rms", "Face error, rms", "corners of the faces against the ideal solid, in edges", "shape"],
  ]),
  firstSections: [["fold", "Net and creases", foldSection]],
};
