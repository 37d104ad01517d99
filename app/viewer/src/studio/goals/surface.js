// A sheet that folds onto a doubly curved surface.
import {field, targetFile} from "./target_file.js";

export const surfaceGoal = {
  name: "surface",
  view: "slant",
  cards: {
    cap: {title: "Cap", about: "A part of a sphere: a flat sheet that curves both ways.",
      fields: [field("width_mm", "square", 100, {unit: "mm wide", min: 20, max: 3000})],
      text: ({width_mm}) => targetFile("cap", `{kind: surface, shape: cap, width_mm: ${width_mm}, arc_deg: 40}`)},
  },
  ghost: (surface) => ({lines: surface.lines_mm}),
};
