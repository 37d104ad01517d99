// Panel whose boundary takes a shape when it is pressed.
import {field, inQuotes, pairs, targetFile} from "./target_file.js";

export const outlineGoal = {
  name: "outline",
  view: "top",
  ghost: ({goal_mm}) => (Array.isArray(goal_mm) && goal_mm.length > 1 ? {lines: [[...goal_mm, goal_mm[0]].map(([x, y]) => [x, y, 0])]} : null),
  cards: {
    outline: {title: "Outline", about: "Draw the boundary that the panel is to have when it is pressed.", pad: true, closed: true, drop: ".csv",
      fields: [field("width_mm", "field", 200, {unit: "mm wide", min: 20, max: 3000})],
      text: ({points, name}) => targetFile("outline", `{kind: outline, points: ${name ? inQuotes(name) : pairs([...points, points[0]])}}`)},
  },
};
