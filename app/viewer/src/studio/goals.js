// Every kind of goal: the cards that ask for it, how its result is looked at, what stands beside it as a ghost.
import {carried} from "../ghost.js";
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

const numbers = ({position_mm: p, quaternion_wxyz: q}) => [...p, ...q];

/**
 * The goal in the frame of the poses, from the result of a search; null where there is none. @param motion of an exact design:
 * results may have the thing elsewhere than its motion, as a helmet on its head
 */
export function ghostOf(design, result, motion) {
  const goal = goalOf(result);
  const ghost = goal?.ghost?.(result[goal.name], design, result) ?? null;
  const state = result?.states?.find(({name}) => name === "target");
  if (!motion || !state?.poses?.[0] || !Number.isFinite(state.theta_rad)) return ghost;
  return carried(ghost, numbers(state.poses[0]), [...motion(state.theta_rad).slice(0, 7)]);
}
