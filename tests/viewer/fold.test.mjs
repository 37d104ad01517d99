// The page's closed form against the program's: every exact state of every shape, and every family.
import assert from "node:assert/strict";
import {readdirSync, readFileSync, writeFileSync} from "node:fs";
import path from "node:path";
import {test} from "node:test";
import {exactMotion} from "../../app/viewer/src/fold.js";
import {foldError} from "./fold_error.mjs";
import {folder, run, SHAPES} from "./program.mjs";

const MOST = 1e-12;  // of the size of the sheet, and of the quaternions

const home = folder();
const result = (name) => JSON.parse(readFileSync(path.join(home, name, "result.json")));

function check(name, {structure, plan, states}) {
  const motion = exactMotion(structure, plan.family), exact = states.filter((state) => state.model === "exact");
  assert.ok(motion && exact.length > 0, name);
  for (const state of exact) {
    const {place, turn} = foldError(state, motion(state.theta_rad), structure);
    assert.ok(place < MOST && turn < MOST, `${name}, theta ${state.theta_rad}: ${place}, ${turn}`);
  }
  return exact.length;
}

// Shapes whose closed form is that of others, and whose searches take longest. KINETIX_SOAK folds them too.
const SLOW = ["qr_code", "circle", "word", "rubber_t", "square_to_disc", "heart", "saddle", "vase", "rubber_rib", "tray_in_mm", "icosahedron", "living_t",
  "cap", "honeycomb_t", "stool", "trefoil_arc", "turned_s", "cube", "open_tray", "handle", "helix", "spectacle_frame", "octahedron", "letter_t", "headform"].map((name) => `${name}.yaml`);
const shapes = readdirSync(SHAPES).filter((name) => name.endsWith(".yaml") && (process.env.KINETIX_SOAK || !SLOW.includes(name)));
for (const shape of shapes)
  test(`folds as ${shape} does`, async () => {
    const name = path.basename(shape, ".yaml"), file = path.join(SHAPES, shape);
    const isDesign = !readFileSync(file, "utf8").includes("target:");
    if (!isDesign) await run(file, "--no-verify", "-o", path.join(home, name));
    else await run("simulate", file, "--model", "exact", "-o", path.join(home, name));
    const found = result(name);
    if (found.plan.family === "none") return;
    if (!found.states.some((state) => state.model === "exact"))
      await run("simulate", path.join(home, name, "design.yaml"), "--model", "exact", "-o", path.join(home, name));
    check(name, result(name));
  });

const TILTS = [20, -10, 0, 33, 5, -25, 14];
const alternating = (place, tilt) => (place % 2 ? -tilt : tilt);

/** A sheet with one tilt a column of walls along x and one a row of walls along y, alternating along them. */
function design(name, columns, rows, ofColumn, ofRow, theta) {
  const wall = (i, j, k, l, beta) => `    - {wall: [[${i}, ${j}], [${k}, ${l}]], t: 0.5, alpha_deg: 90, beta_deg: ${beta}}`, walls = [];
  for (let i = 0; i < columns; ++i) for (let j = 0; j <= rows; ++j) walls.push(wall(i, j, i + 1, j, alternating(j, ofColumn(i))));
  for (let i = 0; i <= columns; ++i) for (let j = 0; j < rows; ++j) walls.push(wall(i, j, i, j + 1, alternating(i, ofRow(j))));
  return ["kinetix: 1", `name: ${name}`, `structure: {cells: [${columns}, ${rows}], cell_mm: 10}`, `design:`, `  theta_deg: ${theta}`, "  hinges:", ...walls, ""].join("\n");
}

const SHEETS = {
  bends: [6, 3, (i) => TILTS[i], () => 0, 25],
  bends_across: [4, 6, () => 0, (j) => TILTS[j], 25],
  zigzag: [6, 3, (i) => TILTS[i], () => 15, 25],
  zigzag_back: [6, 3, (i) => TILTS[i], () => 15, -20],
  zigzag_across: [4, 6, () => -18, (j) => TILTS[j], 25],
  both_alike: [3, 4, () => 12, () => 15, 25],
  one_row: [7, 1, (i) => TILTS[i], () => 21, 25],
};
for (const [name, sheet] of Object.entries(SHEETS))
  test(`folds a sheet that ${name.replaceAll("_", " ")}`, async () => {
    const file = path.join(home, `${name}.yaml`);
    writeFileSync(file, design(name, ...sheet));
    await run("simulate", file, "--model", "exact", "-o", path.join(home, name));
    check(name, result(name));
  });
