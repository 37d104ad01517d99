// A box that folds up.
import {field, number, targetFile} from "./target_file.js";

const box = ({a, b, c, open}) => targetFile("box", `{kind: fold, box_mm: [${[a, b, c].map(number).join(", ")}]${open ? `, open: ${open}` : ""}}`);

export const foldGoal = {
  name: "fold",
  cards: {
    box: {title: "Box", fields: [field("a", "length", 80, {unit: "mm"}), field("b", "width", 40, {unit: "mm"}), field("c", "height", 40, {unit: "mm"}),
      {name: "open", text: "open at", kind: "select", value: "", choices: [["", "nowhere"], ["top", "top"], ["front", "front"], ["left", "left"]]}], text: box},
  },
};
