// A panel whose rim takes a shape when it is pressed.
import {field, inQuotes, pairs, targetFile} from "./target_file.js";

export const outlineGoal = {
  name: "outline",
  view: "top",
  cards: {
    outline: {title: "Outline", about: "Draw the rim that the panel is to have when it is pressed.", pad: true, closed: true, drop: ".csv",
      fields: [field("width_mm", "field", 200, {unit: "mm wide", min: 20, max: 3000})],
      text: ({points, name}) => targetFile("outline", `{kind: outline, points: ${points ? pairs(points) : inQuotes(name)}}`)},
  },
};
