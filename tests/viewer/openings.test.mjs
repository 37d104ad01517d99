// The page's opening of a cell against the program's channel `area`, in a panel whose hinges stretch.
import assert from "node:assert/strict";
import {readFileSync, writeFileSync} from "node:fs";
import path from "node:path";
import {test} from "node:test";
import {areaWithin, cellOutline} from "../../app/viewer/src/cell_outline.js";
import {folder, run} from "./program.mjs";

const MOST = 1e-9; // of a cell's area: result.json rounds no number

const home = folder();

test("reads the area of an opening as the program does", async () => {
  const goal = path.join(home, "bar.yaml");
  const rows = JSON.stringify(["0000", "0110", "0110", "0000"]);
  writeFileSync(goal, `kinetix: 1\ntarget: {kind: display, rows: ${rows}, channel: area}\nstructure: {cell_mm: 10}\n`);
  await run(goal, "--no-verify", "-o", home);
  const {structure, states, display, metrics} = JSON.parse(readFileSync(path.join(home, "result.json")));
  assert.ok(metrics.hinge_gap_max > 1e-3, `hinges stretch by ${metrics.hinge_gap_max}`);
  const poses = states[0].poses.flatMap(({position_mm, quaternion_wxyz}) => [...position_mm, ...quaternion_wxyz]);
  const reported = display.after.cells;
  assert.equal(reported.length, structure.cells.length);
  structure.cells.forEach((cell, k) => {
    const points = cellOutline(structure, cell, poses);
    assert.equal(points.length, 3 * cell.bodies.length);
    assert.ok(Math.abs(areaWithin(points) / structure.cell_mm ** 2 - reported[k]) < MOST, `cell ${k}`);
  });
});

test("has the flat cells' whole area", () => {
  const point = [[0, 0], [1, 0], [1, 1], [0, 1]], middle = [[0.5, 0], [1, 0.5], [0.5, 1], [0, 0.5]];
  const structure = {
    bodies: point.map(([x, y]) => ({position_mm: [x, y, 0]})),
    hinges: middle.map(([x, y]) => ({point_mm: [x, y, 0]})),
  };
  assert.equal(areaWithin(cellOutline(structure, {bodies: [0, 1, 2, 3], hinges: [0, 1, 2, 3]}, null)), 1);
});
