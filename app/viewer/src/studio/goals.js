// All kinds of goals: their cards, the view of their results, and their ghosts.
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

/** Cards with their input fields and the text of their target file. `drop` lists the accepted file endings. */
export const CARDS = {
  ...Object.assign({}, ...GOALS.map(({cards}) => cards)),
  file: {title: "File", about: "A target file (YAML) as it is.", drop: ".yaml,.yml", needsFile: true, fields: [], text: ({content}) => content ?? ""},
};

/** Returns the kind of goal that a result belongs to, if any. */
export const goalOf = (result) => GOALS.find(({name}) => result?.[name]);

/** Returns the distance of every body from the goal of a result, mm; null if the result lacks it. */
export function distancesOf(result) {
  const goal = goalOf(result), section = result?.[goal?.name], state = result?.states?.find(({name}) => name === "target");
  if (Array.isArray(section?.body_mm)) return section.body_mm.map(Math.abs);
  return goal?.apart && state && Array.isArray(section.goal_mm) ? state.poses.map(({position_mm}) => goal.apart(section, position_mm)) : null;
}

/** Returns the goal in the frame of its result; null without a goal. */
export function ghostOf(design, result) {
  const goal = goalOf(result);
  return goal?.ghost?.(result[goal.name], design, result) ?? null;
}

/** Computes the placement of a result's goal on the shown sheet; null if their bodies differ. @param poses 7 numbers
 *  per body */
export function placementOf(result, poses, cell_mm) {
  const state = result?.states?.find(({name}) => name === "target");
  if (state?.poses?.length * 7 !== poses.length) return null;
  return fitted(state.poses.flatMap(({position_mm, quaternion_wxyz}) => [...position_mm, ...quaternion_wxyz]), poses, cell_mm);
}
