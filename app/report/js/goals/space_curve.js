// Space curve: the verdict, the distance along the curve, and the turn or climb of each column.

function readSpaceCurve(raw) {
  if (!raw || typeof raw !== "object") return null;
  const words = (texts) => list(texts).filter((text) => typeof text === "string");
  const columns = list(raw.columns).filter((one) => finite(one?.column) !== null);
  const wanted = numberRows(raw.goal_mm, 3);
  return {
    wanted, backdrop: wanted.length > 1 ? [wanted] : [],
    error: numberRows(raw.error, 2), diagonal: finite(raw.diagonal_mm), slope: finite(raw.slope),
    turns: columns.filter((one) => finite(one.turn_deg) !== null).map((one) => [one.column, one.turn_deg]),
    climbs: columns.filter((one) => finite(one.climb) !== null).map((one) => [one.column, one.climb]),
    meets: raw.walls_meet === true, physics: raw.physics ? dictionary(raw.physics) : null,
    reasons: words(raw.reasons), physicsReasons: words(raw.reasons_physics),
  };
}

function describeOffset(data, rms) {
  const {diagonal} = data.goal;
  if (finite(rms) === null) return "";
  return diagonal === null ? percent(rms) : `${millimetres(rms * diagonal)} (${percent(rms)} of the diagonal)`;
}

function describeSpaceCurve(data) {
  const {goal: wanted, metrics} = data, model = `In the model the middle of the strip lies ${describeOffset(data, metrics.shape_rms)} off the curve, rms.`;
  const run = wanted.physics ? `In the simulation ${describeOffset(data, wanted.physics.rms)}.` : describeSimulation(data);
  return `${model} ${run}${wanted.meets ? " Walls collide on the way to the curve." : ""}`;
}

function spaceNumbers(data) {
  const {metrics, tolerance, goal: wanted} = data;
  const shown = (part) => (wanted.diagonal === null ? percent(part) : millimetres(part * wanted.diagonal));
  return [
    finite(metrics.shape_rms) !== null && keyNumber("Shape error, rms", shown(metrics.shape_rms), `${percent(metrics.shape_rms)} of the diagonal; allowed ${percent(tolerance.shape)}`),
    finite(metrics.shape_max) !== null && keyNumber("Shape error, largest", shown(metrics.shape_max), `${percent(metrics.shape_max)} of the diagonal`),
  ];
}

function drawSpaceError(data, width) {
  const {error} = data.goal, most = Math.max(1e-6, ...error.map(([, off]) => off));
  const axes = plot({
    width, label: "Distance from the curve along the strip",
    x: {range: [0, error[error.length - 1][0] || 1], label: "length along the curve, mm"},
    y: {range: [0, 1.2 * most], label: "distance, mm"},
  });
  axes.root.append(svg("path", {class: "model", d: path(error.map(([arc, off]) => [axes.X(arc), axes.Y(off)]))}));
  return axes.root;
}

function drawByColumn(rows, words, width) {
  const axes = plot({
    width, label: words,
    x: columnAxis(span("Column", "columns", rows.map(([column]) => column)), width),
    y: {range: barRange(rows.map(([, one]) => one)), label: words},
  });
  axes.root.append(...rows.map(([column, one]) => bar(axes, column, one, {class: "turn"})),
                   svg("path", {class: "zero", d: path([[axes.area.left, axes.Y(0)], [axes.area.right, axes.Y(0)]])}));
  return axes.root;
}

function stripAndCurveSection(data) {
  const {goal: wanted} = data;
  return [
    wanted.error.length > 1 && html("div", {class: "part"}, html("h3", {}, "Distance from the curve"), responsive((width) => drawSpaceError(data, width)),
      html("p", {class: "note"}, "Columns bend and shear in turns, so that the strip climbs in steps: a part of this distance that gets smaller with the cells.")),
    wanted.turns.length > 0 && html("div", {class: "part"}, html("h3", {}, "Columns that bend"), responsive((width) => drawByColumn(wanted.turns, "turn, degrees", width))),
    wanted.climbs.length > 0 && html("div", {class: "part"}, html("h3", {}, "Columns that shear"),
      responsive((width) => drawByColumn(wanted.climbs, "step across the strip, of its length", width))),
  ];
}

const space_curveGoal = {
  name: "space_curve",
  read: (raw) => readSpaceCurve(raw.space_curve),
  view: "slant",
  backdropKey: ["head", "target curve"],
  describe: describeSpaceCurve,
  numbers: spaceNumbers,
  firstSections: [["space-errors", "Strip and curve", stripAndCurveSection]],
  lastSections: [],
};
