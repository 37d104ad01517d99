// Letter or picture that appears when the panel is pressed.
import {pictureUnder} from "../../ghost.js";
import {field, inQuotes, number, targetFile} from "./target_file.js";

function letter({glyph, cells, cell_mm}) {
  const plain = glyph.replace(/[^A-Za-z0-9]/g, "") || "letter";
  return targetFile(plain, `{kind: display, glyph: ${inQuotes(glyph)}}`,
    [`structure: {cells: [${cells * Math.max(1, [...glyph].length)}, ${cells}], cell_mm: ${number(cell_mm)}}`]);
}

const picture = ({name, cell_mm, invert}) => targetFile("picture", `{kind: display, image: ${inQuotes(name)}${invert ? ", invert: true" : ""}}`,
  [`structure: {cell_mm: ${number(cell_mm)}}`]);

export const displayGoal = {
  name: "display",
  view: "top",
  light: true,
  ghost(display, design, result) {
    const rows = result.target?.rows, state = result.states?.find(({name}) => name === "target");
    if (!rows?.length || !state) return null;
    return {picture: pictureUnder(rows, state.poses.map(({position_mm}) => position_mm), design.structure.wall_mm.height)};
  },
  cards: {
    letter: {title: "Letter", fields: [{name: "glyph", text: "letter or word", value: "A", kind: "text"}, field("cells", "cells a letter", 10, {min: 6, max: 40, step: 1}),
      field("cell_mm", "cell", 15, {unit: "mm"})], text: letter},
    image: {title: "Picture", about: "A PNG or JPEG; its dark parts show when the panel is pressed.", drop: ".png,.jpg,.jpeg,.pbm,.pgm", needsFile: true,
      fields: [field("cell_mm", "cell", 15, {unit: "mm"}), {name: "invert", text: "light parts show", kind: "checkbox", value: false}], text: picture},
  },
};
