// Box or solid that folds up.
import {field, number, targetFile} from "./target_file.js";

const box = ({a, b, c, open}) => targetFile("box", `{kind: fold, box_mm: [${[a, b, c].map(number).join(", ")}]${open ? `, open: ${open}` : ""}}`);

const SOLIDS = ["tetrahedron", "octahedron", "icosahedron", "dodecahedron", "cube"];
const solid = ({shape, cells, cell_mm}) => targetFile(shape, `{kind: fold, solid: ${shape}, cells: ${cells}}`, [`structure: {cell_mm: ${number(cell_mm)}}`]);

export const foldGoal = {
  name: "fold",
  ghost: ({ideal_mm}) => (Array.isArray(ideal_mm) ? {lines: ideal_mm} : null),
  cards: {
    box: {title: "Box", fields: [field("a", "length", 80, {unit: "mm"}), field("b", "width", 40, {unit: "mm"}), field("c", "height", 40, {unit: "mm"}),
      {name: "open", text: "open at", kind: "select", value: "", choices: [["", "nowhere"], ["top", "top"], ["front", "front"], ["left", "left"]]}], text: box},
    solid: {title: "Solid", about: "A regular solid that folds up from one flat net.", fields: [{name: "shape", text: "solid", kind: "select", value: "octahedron", choices: SOLIDS.map((name) => [name, name])},
      field("cells", "cells along half a side", 3, {min: 2, max: 12, step: 1}), field("cell_mm", "cell", 10, {unit: "mm"})], text: solid},
  },
};
