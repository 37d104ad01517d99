// Sheet that folds onto a doubly curved surface, or a fishbone of ribs over it.
import {field, inQuotes, number, targetFile} from "./target_file.js";

const FACETS = field("facets", "facets along a side", 8, {min: 2, max: 24, step: 1});
const RIBS = field("ribs", "ribs instead of a sheet", 0, {min: 0, max: 60, step: 1});
const WIDTH = field("width_mm", "wide", 100, {unit: "mm", min: 20, max: 5000});
const RISE_PER_DEGREE = 0.00375;                   // rise of a saddle over half its width, per degree: 0.15 at 40 degrees
const VASE_HEIGHT = 4 / 3, VASE_SWELL = 1 / 30;  // over its radius
const made = ({ribs, facets}) => (ribs > 0 ? [] : [`structure: {facets: [${facets}, ${facets}]}`]);
const over = ({ribs}) => (ribs > 0 ? `, ribs: ${ribs}` : "");

/** Returns the sizes of a vase with this width of its front. @param arc deg */
function vase(wide, arc) {
  const radius = wide / (2 * Math.sin((arc * Math.PI) / 360));
  return `height_mm: ${number(VASE_HEIGHT * radius)}, radius_mm: ${number(radius)}, swell_mm: ${number(VASE_SWELL * radius)}, arc_deg: ${number(arc)}`;
}

function shaped(values) {
  const {shape, width_mm: wide, arc_deg: arc} = values;
  const sizes = {cap: `width_mm: ${number(wide)}, arc_deg: ${number(arc)}`, saddle: `width_mm: ${number(wide)}, rise: ${number(RISE_PER_DEGREE * arc)}`,
    vase: vase(wide, arc)}[shape];
  return targetFile(shape, `{kind: surface, shape: ${shape}, ${sizes}${over(values)}}`, made(values));
}

const scanned = (values) => targetFile("surface", `{kind: surface, mesh: ${inQuotes(values.name)}, units: ${values.units}${over(values)}}`, made(values));

export const surfaceGoal = {
  name: "surface",
  view: "slant",
  cards: {
    surface: {title: "Surface", about: "Part of a sphere, a saddle or the front of a vase. A sheet comes near to it and mostly misses its curvature; ribs follow it.",
      fields: [{name: "shape", text: "shape", kind: "select", value: "cap", choices: [["cap", "cap"], ["saddle", "saddle"], ["vase", "vase"]]}, WIDTH,
        field("arc_deg", "it turns by", 40, {unit: "\u00b0", max: 120}), FACETS, RIBS], text: shaped},
    mesh: {title: "Mesh", about: "A sheet or ribs over a mesh: OBJ, OFF, STL, PLY, 3MF, GLB or STEP. A sheet takes an open one without holes, ribs any.", drop: ".obj,.off,.stl,.ply,.3mf,.glb,.step,.stp", needsFile: true,
      fields: [{name: "units", text: "mesh is in", kind: "select", value: "mm", choices: [["mm", "mm"], ["cm", "cm"], ["m", "m"], ["in", "inches"]]}, FACETS, RIBS], text: scanned},
  },
  ghost: (surface) => ({lines: surface.lines_mm, bare: surface.bare_mm}),
};
