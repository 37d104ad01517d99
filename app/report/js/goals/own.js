// Custom goal, measured by a Python function: its error, in the unit of that function.

function readCustom(raw) {
  if (!raw || typeof raw !== "object") return null;
  const words = (texts) => list(texts).filter((text) => typeof text === "string");
  return {count: list(raw.residuals).length, reasons: words(raw.reasons), physicsReasons: words(raw.reasons_physics)};
}

function describeCustomError({goal: own, metrics, tolerance}) {
  const limit = finite(tolerance.error) === null ? "" : `, and ${neat(tolerance.error)} is allowed`;
  return `Its error is ${figures(metrics.error)}${own.count > 1 ? `, the root of the sum of squares of ${own.count} numbers` : ""}${limit}.`;
}

function describeCustomResult(data) {
  return `${describeCustomError(data)} ${describeSimulation(data)}`;
}

const customGoal = {
  name: "own",
  read: (raw) => readCustom(raw.own),
  view: "side",
  describe: describeCustomResult,
  numbers: (data) => measures(data, [["error", "Error", "in the unit of the error function", "error"]]),
  fitText: (error) => figures(error),
  firstSections: [],
  lastSections: [["tilts", "Tilts per column", tiltSection]],
};
