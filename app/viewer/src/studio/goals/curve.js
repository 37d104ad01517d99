// Strip that bends into a curve: around a wrist, or drawn.
import {offLine} from "../../ghost.js";
import {field, inQuotes, number, pairs, targetFile} from "./target_file.js";

const GAP_DEG = 50;  // of a bracelet: opening for the wrist
const POINTS = 72;   // of its circle: about one every 4 degrees

/** Returns points along an open circle around a wrist. The circle's radius includes half the wall's height. */
export function braceletPoints(round_mm, height_mm, gap_deg = GAP_DEG) {
  const radius = round_mm / (2 * Math.PI) + height_mm / 2, start = -90 + gap_deg / 2;
  return Array.from({length: POINTS + 1}, (_, k) => {
    const angle = ((start + ((360 - gap_deg) * k) / POINTS) * Math.PI) / 180;
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });
}

function bracelet({round_mm, columns, rows, height_mm}) {
  const points = braceletPoints(round_mm, height_mm), length = Math.PI * (round_mm / Math.PI + height_mm) * (1 - GAP_DEG / 360);
  const thickness = number(Math.min(1.2, 0.1 * (length / columns)));
  return targetFile("bracelet", `{kind: curve, points: ${pairs(points)}}`,
    [`structure: {cells: [${columns}, ${rows}], wall_mm: {thickness: ${thickness}, height: ${number(height_mm)}}}`]);
}

const drawn = ({name, points, columns, rows}) => targetFile("curve", `{kind: curve, points: ${name ? inQuotes(name) : pairs(points)}}`,
  [`structure: {cells: [${columns}, ${rows}]}`]);

/** Makes a surface from the curve, a little wider than the strip, which makes it visible on both sides. */
function ribbon(goal, ys, more) {
  const [front, back] = [Math.min(...ys) - more, Math.max(...ys) + more].map((y) => goal.map(([x, z]) => [x, y, z]));
  const triangles = goal.slice(1).flatMap((_, k) => [[front[k], front[k + 1], back[k + 1]], [front[k], back[k + 1], back[k]]]);
  return {lines: [front, back], triangles};
}

export const curveGoal = {
  name: "curve",
  apart: ({goal_mm}, [x, , z]) => offLine(goal_mm, [x, z]),
  cards: {
    bracelet: {title: "Bracelet", fields: [field("round_mm", "wrist", 170, {unit: "mm round", min: 60, max: 600}), field("columns", "columns", 24, {min: 8, max: 120, step: 1}),
      field("rows", "rows", 3, {max: 12, step: 1}), field("height_mm", "walls", 6, {unit: "mm high", max: 40})], text: bracelet},
    curve: {title: "Curve", about: "Draw the side view of the folded strip.", pad: true, drop: ".csv", fields: [field("width_mm", "field", 200, {unit: "mm wide", min: 20, max: 3000}),
      field("columns", "columns", 40, {min: 4, max: 200, step: 1}), field("rows", "rows", 1, {max: 12, step: 1})], text: drawn},
  },
  ghost({goal_mm}, design, result) {
    if (!Array.isArray(goal_mm) || goal_mm.length < 2) return null;
    // The folded strip is narrower than the flat one.
    const state = result.states?.find(({name}) => name === "target"), ys = (state?.poses ?? design.structure.bodies).map(({position_mm}) => position_mm[1]);
    return ribbon(goal_mm, ys, 0.75 * design.structure.cell_mm);
  },
};
