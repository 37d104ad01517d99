// A box that folds up.
import {field, number, targetFile} from "./target_file.js";

const CELLS = 4;        // along the shortest edge, about
const MOST_CELLS = 40;  // along the longest one

/** Cells of a box and their edge, so that its size in mm is met best. */
export function boxCells(size_mm) {
  const shortest = Math.min(...size_mm), most = Math.max(...size_mm);
  let best = null;
  for (let count = 1; count <= 2 * CELLS; ++count) {
    const edge = shortest / count, cells = size_mm.map((v) => Math.max(1, Math.round(v / edge)));
    if (most / edge > MOST_CELLS && best) break;
    const miss = Math.max(...size_mm.map((v, k) => Math.abs(cells[k] * edge - v) / v)) + 0.01 * Math.abs(count - CELLS);
    if (!best || miss < best.miss) best = {cells, edge, miss};
  }
  return best;
}

function box({a, b, c, open}) {
  const {cells, edge} = boxCells([a, b, c]);
  return targetFile("box", `{kind: fold, box: [${cells.join(", ")}]${open ? `, open: ${open}` : ""}}`, [`structure: {cell_mm: ${number(edge)}}`]);
}

export const foldGoal = {
  name: "fold",
  cards: {
    box: {title: "Box", fields: [field("a", "length", 80, {unit: "mm"}), field("b", "width", 40, {unit: "mm"}), field("c", "height", 40, {unit: "mm"}),
      {name: "open", text: "open at", kind: "select", value: "", choices: [["", "nowhere"], ["top", "top"], ["front", "front"], ["left", "left"]]}], text: box},
  },
};
