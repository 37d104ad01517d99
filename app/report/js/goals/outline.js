// Outline: the verdict on a panel's boundary, and the active bounds.

function readOutline(raw) {
  if (!raw || typeof raw !== "object") return null;
  const words = (texts) => list(texts).filter((text) => typeof text === "string");
  const part = (error) => (error ? {rms: finite(error.rms), max: finite(error.max), iou: finite(error.iou)} : null);
  const outline = numberRows(raw.goal_mm, 2).map(([x, y]) => [x, y, 0]);
  return {
    outline,
    backdrop: outline.length > 1 ? [[...outline, outline[0]]] : [],
    diagonal: finite(raw.diagonal_mm), size: finite(raw.size),
    exact: part(raw.exact), flat: part(raw.flat), physics: part(raw.physics),
    offset: finite(raw.offset_mm), turn: finite(raw.turn),
    bounds: dictionary(raw.at_bounds), meets: raw.walls_meet === true, cuts: finite(raw.cuts) ?? 0,
    reasons: words(raw.reasons), physicsReasons: words(raw.reasons_physics),
  };
}

function describeOutline({diagonal}, error) {
  if (!error || error.rms === null) return "";
  const length = diagonal === null ? percent(error.rms) : `${millimetres(error.rms * diagonal)} (${percent(error.rms)} of the diagonal)`;
  return `the boundary is ${length} off the outline, and they share ${percent(error.iou)} of their area`;
}

function describeOutlineResult(data) {
  const {goal: outline} = data;
  const run = outline.physics ? `In the simulation ${describeOutline(outline, outline.physics)}.` : describeSimulation(data);
  return `In the model ${describeOutline(outline, outline.exact)}. ${run}`;
}

function outlineNumbers(data) {
  const {goal: outline, tolerance} = data, {exact} = outline;
  if (!exact) return [];
  const shown = outline.diagonal === null ? percent(exact.rms) : millimetres(exact.rms * outline.diagonal);
  return [
    keyNumber("Boundary from outline, rms", shown, `${percent(exact.rms)} of the diagonal; allowed ${percent(tolerance.shape)}`),
    keyNumber("Area shared", percent(exact.iou), `over the area of both; at least ${percent(tolerance.iou)}`),
    outline.size !== null && Math.abs(outline.size - 1) > 5e-3 &&
        keyNumber("Size", `${figures(outline.size, 3)} \u00d7`, "the panel against the outline as drawn"),
  ];
}

function outlineSection(data) {
  const {goal: outline} = data, rows = [];
  const row = (name, error) => error && rows.push({cells: [name, percent(error.rms), percent(error.max), percent(error.iou)]});
  row("model, pressed", outline.exact);
  row("model, flat", outline.flat);
  row("simulation, pressed", outline.physics);
  return [
    table(["state", "rms", "largest", "area shared"], rows, "Boundary against outline, relative to the outline\u2019s diagonal"),
    html("p", {class: "note"},
         `Hinges are up to ${millimetres(outline.offset ?? 0)} off the middle of their walls, across the wall. ` +
             `${percent(outline.bounds.offset ?? 0)} of the walls have the largest allowed offset, ` +
             `${percent(outline.bounds.turn ?? 0)} have the largest allowed turn` +
             (outline.cuts > 1 ? `; the panel is the best of ${outline.cuts} cuts of the lattice.` : ".")),
  ];
}

const outlineGoal = {
  name: "outline",
  read: (raw) => readOutline(raw.outline),
  view: "top",
  backdropKey: ["head", "target outline"],
  describe: describeOutlineResult,
  numbers: outlineNumbers,
  firstSections: [["outline", "Boundary and outline", outlineSection]],
  lastSections: [],
};
