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

function customVerdict(data) {
  const {verdict: {met, verified}} = data, model = describeCustomError(data);
  const hasRun = finite(data.metrics.verify_rms) !== null || Boolean(data.physics.status), run = hasRun ? ` ${describePhysics(data)}` : "";
  if (met === false) return {mark: "\u2715", tone: "bad", title: "The strip misses its goal", text: model + run};
  if (verified === false)
    return {mark: "!", tone: "bad", title: "It meets its goal in the model, but the simulation " + failing(data), text: model + run};
  return {
    mark: "\u2713", tone: verified ? "good" : "unsure",
    title: verified ? "The strip meets its goal, and the simulation agrees" : "The strip meets its goal in the model",
    text: model + (run || " It was not checked by a simulation."),
  };
}

const customGoal = {
  name: "own",
  read: (raw) => readCustom(raw.own),
  view: "side",
  verdict: customVerdict,
  numbers: (data) => measures(data, [["error", "Error", "in the unit of the error function", "error"]]),
  fitText: (error) => figures(error),
  firstSections: [],
  lastSections: [["tilts", "Tilts per column", tiltSection]],
};
