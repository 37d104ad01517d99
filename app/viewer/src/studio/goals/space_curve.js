// Strip that bends and twists into a curve in space.
import {offLine} from "../../ghost.js";
import {field, inQuotes, targetFile} from "./target_file.js";

export const space_curveGoal = {
  name: "space_curve",
  apart: ({goal_mm}, p) => offLine(goal_mm, p),
  cards: {
    space_curve: {title: "Curve in space", about: "A table of points x,y,z in mm, or a GPX track.", drop: ".csv,.txt,.dat,.gpx", needsFile: true,
      fields: [field("columns", "columns", 48, {min: 8, max: 400, step: 1})],
      text: ({name, columns}) => targetFile("space_curve", `{kind: space_curve, points: ${inQuotes(name)}}`, [`structure: {cells: [${columns}, 1]}`])},
  },
  ghost: ({goal_mm}) => (Array.isArray(goal_mm) && goal_mm.length > 1 ? {lines: [goal_mm]} : null),
};
