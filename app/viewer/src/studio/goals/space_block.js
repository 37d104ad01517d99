// Block of rotors and gussets that shrinks in all directions at once.
import {field, targetFile} from "./target_file.js";

export const space_blockGoal = {
  name: "space_block",
  cards: {
    space_block: {title: "Shrinking block", about: "A block in space that shrinks equally in all directions when it is pressed.",
      fields: [field("factor", "pressed over at rest", 0.85, {min: 0.6, max: 0.98, step: 0.01}), field("cells", "cells per side", 2, {min: 1, max: 4, step: 1})],
      text: ({factor, cells}) => targetFile("space_block", `{kind: space_block, factor: ${factor}}`, [`structure: {cells: [${cells}, ${cells}, ${cells}]}`])},
  },
};
