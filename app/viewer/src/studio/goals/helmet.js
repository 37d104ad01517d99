// Dome over a head, which is given as a mesh.
import {field, inQuotes, number, targetFile} from "./target_file.js";

export const helmetGoal = {
  name: "helmet",
  ghost: ({head_mm, bare_mm}) => (Array.isArray(head_mm) ? {lines: head_mm, bare: bare_mm} : null),
  cards: {
    helmet: {title: "Helmet", about: "A mesh of a head: OBJ, OFF, STL, PLY, 3MF, GLB or STEP.", drop: ".obj,.off,.stl,.ply,.3mf,.glb,.step,.stp", needsFile: true, fields: [field("ribs", "ribs", 8, {max: 60, step: 1}),
      field("clearance_mm", "room to the head", 5, {unit: "mm", min: 0, max: 100}), {name: "units", text: "mesh is in", kind: "select", value: "mm", choices: [["mm", "mm"], ["cm", "cm"], ["m", "m"], ["in", "inches"]]}],
      text: ({name, ribs, clearance_mm, units}) => targetFile("helmet", `{kind: helmet, mesh: ${inQuotes(name)}, units: ${units}, ribs: ${ribs}, clearance_mm: ${number(clearance_mm)}}`)},
  },
};
