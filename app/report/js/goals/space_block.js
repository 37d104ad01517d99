// Space block: the verdict, and the lengths at rest and pressed.

function readSpaceBlock(raw) {
  if (!raw || typeof raw !== "object") return null;
  const words = (texts) => list(texts).filter((text) => typeof text === "string");
  const three = (values) => (list(values).length === 3 && values.every((one) => finite(one) !== null) ? values : null);
  return {factors: three(raw.factors), gussets: three(raw.gussets),
    physics: three(dictionary(raw.physics).factors), reasons: words(raw.reasons), physicsReasons: words(raw.reasons_physics)};
}

function formatFactors(factors) {
  return factors === null ? "" : factors.map((one) => percent(one)).join(", ");
}

function describeSpaceBlock(data) {
  const {goal: block} = data;
  const model = `In the model its sides shrink to ${formatFactors(block.factors)} of their lengths, along x, y and z.`;
  return `${model} ${block.physics ? `In the simulation, between plates, to ${formatFactors(block.physics)}.` : describeSimulation(data)}`;
}

function spaceBlockNumbers(data) {
  const {goal: block, tolerance, metrics} = data;
  return [
    block.factors && keyNumber("Pressed over at rest", formatFactors(block.factors), `along x, y, z; off by at most ${percent(metrics.factor_off)}, allowed ${percent(tolerance.factor)}`),
    block.gussets && keyNumber("Gussets", block.gussets.map((one) => figures(one, 2)).join(", "), "of an edge, in squares normal to x, y, z: pieces between two rotors that never turn"),
  ];
}

const space_blockGoal = {
  name: "space_block",
  read: (raw) => readSpaceBlock(raw.space_block),
  view: "slant",
  describe: describeSpaceBlock,
  numbers: spaceBlockNumbers,
  firstSections: [],
  lastSections: [],
};
