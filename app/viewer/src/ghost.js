// The goal next to the sheet, in mm: {lines: [[[x, y, z]]], triangles: [[[x, y, z]]], picture: {source, corners}}.
// Corners start at the lower left, counter-clockwise.
import {cssColour} from "./colours.js";

/** Computes the distance of p from a polyline in any dimension. */
export function offLine(points, p) {
  let least = Infinity;
  for (let k = 1; k < points.length; ++k) {
    const a = points[k - 1], way = points[k].map((v, i) => v - a[i]), size = way.reduce((sum, v) => sum + v * v, 0) || 1;
    const share = Math.max(0, Math.min(1, way.reduce((sum, v, i) => sum + v * (p[i] - a[i]), 0) / size));
    least = Math.min(least, Math.hypot(...way.map((v, i) => a[i] + share * v - p[i])));
  }
  return least;
}

/** Makes a picture under the bodies. @param rows texts from the top, "1" for dark   @param places of the bodies, mm
 *  @param drop distance below them, mm */
export function pictureUnder(rows, places, drop) {
  const source = document.createElement("canvas"), context = source.getContext("2d");
  Object.assign(source, {width: Math.max(...rows.map((row) => row.length)), height: rows.length});
  context.fillStyle = `#${cssColour("goal").getHexString()}`;
  rows.forEach((row, j) => [...row].forEach((letter, i) => letter === "1" && context.fillRect(i, j, 1, 1)));
  const low = [0, 1, 2].map((k) => Math.min(...places.map((p) => p[k]))), high = [0, 1, 2].map((k) => Math.max(...places.map((p) => p[k])));
  const z = low[2] - drop;
  return {source, corners: [[low[0], low[1], z], [high[0], low[1], z], [high[0], high[1], z], [low[0], high[1], z]]};
}
