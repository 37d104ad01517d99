// Certified collision-free range of theta to both sides, as designed and as printed.

function readLimit(raw) {
  const limit = dictionary(raw);
  return {theta: toDegrees(limit.theta_rad), contact: toDegrees(limit.contact_rad), walls: list(limit.walls).map(String)};
}

function readRange(raw) {
  const range = dictionary(raw);
  return {growth: finite(range.growth_mm), low: readLimit(range.low), high: readLimit(range.high), leftOut: finite(range.left_out) ?? 0};
}

/** Reads the section `certified`; null without a check. */
function readCertified(raw) {
  if (!someDictionary(raw)) return null;
  if (typeof raw.why_not === "string") return {whyNot: raw.why_not};
  return {isExact: raw.states_are_exact !== false, hasLeft: raw.states_have_left === true, design: readRange(raw.design), printed: readRange(raw.printed), covers: raw.covers_theta === true, coversPrinted: raw.covers_theta_printed === true};
}

function describeRange({low, high}) {
  return `fold angles from ${degrees(low.theta)} to ${degrees(high.theta)}`;
}

function describeLimit({walls, contact}, side) {
  if (walls.length < 2) return `For ${side} angles no collision was found up to the end of the search.`;
  const seen = finite(contact) === null ? "come closer than the rounding error" : `collide at ${degrees(contact)}`;
  return `For ${side} angles it ends at walls ${walls[0]} and ${walls[1]}, which ${seen}.`;
}

function thetaPlace(covers, {hasLeft}) {
  if (hasLeft) return "does not follow this motion";
  return covers ? "is inside" : "is outside: walls may collide during folding";
}

/** Draws a bar for each range, and a line at the theta of the reported state. */
function drawRanges({certified, metrics}, width) {
  const bars = [["as designed", certified.design], ["with errors", certified.printed]], row = 34, left = 92, height = bars.length * row + 44;
  const theta = certified.hasLeft ? null : toDegrees(metrics.theta_rad), ends = [...bars.flatMap(([, {low, high}]) => [low.theta, high.theta]), theta ?? 0, 0];
  const X = mapping({range: padded([Math.min(...ends), Math.max(...ends)])}, left, width - 14);
  const line = (at, kind) => svg("path", {class: kind, d: path([[X(at), 4], [X(at), bars.length * row + 4]])});
  return drawing(
      width, height, "Collision-free fold angles, as designed and with print errors",
      bars.map(([name, {low, high}], k) => [
        svg("text", {class: "label", x: 2, y: k * row + 24}, name),
        svg("rect", {class: "bar free", x: X(low.theta), y: k * row + 10, width: Math.max(X(high.theta) - X(low.theta), 1), height: 20})
      ]),
      line(0, "zero"), theta === null ? null : line(theta, "best"),
      svg("text", {class: "label", x: X(0), y: height - 22, "text-anchor": "middle"}, "flat"),
      theta === null ? null : svg("text", {class: "label", x: X(theta), y: height - 4, "text-anchor": theta > 0 ? "end" : "start"}, `this state, ${degrees(theta)}`));
}

function describeLeftOut({leftOut}) {
  return leftOut ? ` ${count(leftOut, "pair of plates touches", "pairs of plates touch")} in the flat sheet and ${leftOut === 1 ? "is" : "are"} not checked.` : "";
}

const ELASTIC_TEXT = " Computed for ideal hinges; the elastic solution stays close to this motion.";

const LEFT_TEXT = "Collisions were not checked for this state: the elastic solution departs from the ideal motion that the check covers. For the ideal motion,";

const isProvenOfOthers = ({certified}) => certified?.hasLeft === true;

function certifiedSection(data) {
  const {certified} = data;
  if (certified.whyNot) return html("p", {}, `Collisions were not checked: ${certified.whyNot}.`);
  const {design, printed} = certified;
  return [
    html("p", {}, `${certified.hasLeft ? LEFT_TEXT + " no" : "No"} two walls collide for ${describeRange(design)}. The check is continuous, not at sampled angles. This state ${
        thetaPlace(certified.covers, certified)}.${certified.isExact || certified.hasLeft ? "" : ELASTIC_TEXT} ${describeLimit(design.high, "positive")} ${describeLimit(design.low, "negative")}${describeLeftOut(design)}`),
    responsive((width) => drawRanges(data, width)),
    html("p", {}, `With print errors (walls up to ${millimetres(printed.growth)} out of place, three standard deviations): ${describeRange(printed)}. This state ${
        thetaPlace(certified.coversPrinted, certified)}. The hinges themselves are not included.`)
  ];
}
