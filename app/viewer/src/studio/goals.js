// Every kind of goal: the cards that ask for it, how its result is looked at, what stands beside it as a ghost.
import {fitted} from "../placement.js";
import {curveGoal} from "./goals/curve.js";
import {displayGoal} from "./goals/display.js";
import {foldGoal} from "./goals/fold.js";
import {helmetGoal} from "./goals/helmet.js";
import {outlineGoal} from "./goals/outline.js";
import {surfaceGoal} from "./goals/surface.js";
import {space_blockGoal} from "./goals/space_block.js";
import {space_curveGoal} from "./goals/space_curve.js";

const GOALS = [
  curveGoal,
  displayGoal,
  foldGoal,
  outlineGoal,
  surfaceGoal,
  space_blockGoal,
  space_curveGoal,
  helmetGoal,
];

/** Each card: what is asked for, and the text of the target file that follows. `drop` are endings of files it takes. */
export const CARDS = {
  ...Object.assign({}, ...GOALS.map(({cards}) => cards)),
  file: {title: "File", about: "A target file (YAML) as it is.", drop: ".yaml,.yml", needsFile: true, fields: [], text: ({content}) => content ?? ""},
};

/** The kind of goal that a result is of; nothing where it is of none. */
export const goalOf = (result) => GOALS.find(({name}) => result?.[name]);

/** How far every body lies off the goal of a result, mm; null where it does not say. */
export function distancesOf(result) {
  const goal = goalOf(result), section = result?.[goal?.name], state = result?.states?.find(({name}) => name === "target");
  if (Array.isArray(section?.body_mm)) return section.body_mm.map(Math.abs);
  return goal?.apart && state && Array.isArray(section.goal_mm) ? state.poses.map(({position_mm}) => goal.apart(section, position_mm)) : null;
}

/** The goal in the frame of the result that it came with; null where there is none. */
export function ghostOf(design, result) {
  const goal = goalOf(result);
  return goal?.ghost?.(result[goal.name], design, result) ?? null;
}

/** How the goal of a result is laid onto the sheet that is shown; null where their bodies are not the same. @param poses 7 numbers a body */
export function placementOf(result, poses, cell_mm) {
  const state = result?.states?.find(({name}) => name === "target");
  if (state?.poses?.length * 7 !== poses.length) return null;
  return fitted(state.poses.flatMap(({position_mm, quaternion_wxyz}) => [...position_mm, ...quaternion_wxyz]), poses, cell_mm);
}
