// Every kind of goal: the cards that ask for it, how its result is looked at, what stands beside it as a ghost.
import {curveGoal} from "./goals/curve.js";
import {displayGoal} from "./goals/display.js";
import {foldGoal} from "./goals/fold.js";
import {helmetGoal} from "./goals/helmet.js";
import {outlineGoal} from "./goals/outline.js";
import {surfaceGoal} from "./goals/surface.js";
import {space_curveGoal} from "./goals/space_curve.js";

const GOALS = [
  curveGoal,
  displayGoal,
  foldGoal,
  outlineGoal,
  surfaceGoal,
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

/** The goal in the frame of the poses, from the result of a search; null where there is none. */
export function ghostOf(design, result) {
  const goal = goalOf(result);
  return goal?.ghost?.(result[goal.name], design, result) ?? null;
}
