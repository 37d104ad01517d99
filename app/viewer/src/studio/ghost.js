// The goal as it is drawn beside the thing: from the design's own message, or from the result of a search.

/** Lines in the frame of the poses; null where there is nothing to show. */
export function ghostOf(design, result) {
  if (design?.goal?.lines) return {lines: design.goal.lines};
  const goal = result?.curve?.goal_mm;
  if (!Array.isArray(goal) || goal.length < 2) return null;
  // Where the strip is folded, it is narrower than flat.
  const state = result.states?.find(({name}) => name === "target"), ys = (state?.poses ?? design.structure.bodies).map(({position_mm}) => position_mm[1]);
  return ribbon(goal, ys, 0.75 * design.structure.cell_mm);
}

/** The curve over the whole width of the strip and a little more, so that it shows on both sides. */
function ribbon(goal, ys, more) {
  const [front, back] = [Math.min(...ys) - more, Math.max(...ys) + more].map((y) => goal.map(([x, z]) => [x, y, z]));
  const triangles = goal.slice(1).flatMap((_, k) => [[front[k], front[k + 1], back[k + 1]], [front[k], back[k + 1], back[k]]]);
  return {lines: [front, back], triangles};
}
