// The goal as it is drawn beside the thing: from the design's own message, or from the result of a search.

/** Lines in the frame of the poses; null where there is nothing to show. */
export function ghostOf(design, result) {
  if (design?.goal?.lines) return {lines: design.goal.lines};
  const goal = result?.curve?.goal_mm;
  if (!Array.isArray(goal) || goal.length < 2) return null;
  // The curve lies in the middle of the strip's width.
  const ys = design.structure.bodies.map(({position_mm}) => position_mm[1]), y = 0.5 * (Math.min(...ys) + Math.max(...ys));
  return {lines: [goal.map(([x, z]) => [x, y, z])]};
}
