// The report of an equilibrium in the browser, with and without a simulation.
import assert from "node:assert/strict";
import {writeFileSync} from "node:fs";
import path from "node:path";
import {test} from "node:test";
import {ended, folder} from "./studio.mjs";
import {page, runs} from "./report_page.mjs";

const home = folder();

/** Writes a design. @returns its file, and a folder for results */
function design(name, ...lines) {
  const file = path.join(home, `${name}.yaml`);
  writeFileSync(file, ["kinetix: 1", ...lines, ""].join("\n"));
  return [file, path.join(home, name)];
}

const panel = (name, drive) => design(name, "structure: {cells: [4, 3], cell_mm: 10}", "design: {hinges: [{wall: [[1, 1], [2, 1]], t: 0.4}]}",
  `drive: ${drive}`, "hinge: {model: elastic}");

async function drawEquilibrium([file, out]) {
  await runs(0, "simulate", file, "--model", "equilibrium", "--quiet", "-o", out);
  await page.draw(out);
}

test("an equilibrium that the simulation confirms has its force, energy and contacts", async () => {
  const [file, out] = panel("verified", "{kind: plates, axis: y, compression: 0.25}");
  await runs(0, "verify", file, "--quiet", "-o", out);
  await page.draw(out);
  page.holds("<h2>Reached by its drive, simulation agrees</h2>");
  page.drawn("load", 'class="badge"');
  page.drawn("load", "walls touch");
  page.drawn("energy", 'class="heat"');
  page.drawn("plan", "Walls in contact");
  page.holds("<dt>Force</dt><dd>");
  page.holds("hinge stiffness is assumed, set `hinge:` to change it</dd>");
  for (const id of ["errors", "tilts", "search", "stable"]) page.absent(id);
});

test("a drive that stops before its end is reported", async () => {
  const [file, out] = panel("stopped", "{kind: plates, axis: y, compression: 0.7}");
  const {code} = await ended("simulate", file, "--model", "equilibrium", "--quiet", "-o", out);
  assert.notEqual(code, 0);
  await page.draw(out);
  page.holds("The drive stopped");
});

test("a twist has a barrier and two stable states", async () => {
  await drawEquilibrium(design("twist", "structure: {cells: [1, 1], cell_mm: 20, wall_mm: {thickness: 0.4, height: 8}}",
    "design: {pattern: {even: {A_in_deg: [90, 60, 90, 60]}}}", "drive: {kind: hinge, wall: [[0, 0], [0, 1]], angle_deg: 96}",
    "hinge: {model: elastic, k_turn: 0.001}"));
  page.holds(" N mm at most, ");
  page.drawn("load", "barrier A–B");
  page.drawn("load", "load peaks");
  page.drawn("stable", 'aria-label="Stable state B"');
  page.drawn("stable", "Between A and B the energy rises to");
});

test("springs fold it without a force", async () => {
  await drawEquilibrium(panel("springs", "{kind: shape_memory, angle_deg: 20, k_turn: 5}"));
  page.holds("<dt>Force</dt><dd>none; springs in the hinges fold it</dd>");
});

test("a sheet that one hinge moves has the size that its closed form has, however it lies", async () => {
  await drawEquilibrium(design("aslant", "structure: {cells: [4, 4], cell_mm: 10}", "drive: {kind: hinge, wall: [[0, 0], [1, 0]], angle_deg: 40}", "hinge: {model: elastic}"));
  page.holds("Folded</dt><dd>41.9 × 41.9 × 6.00 mm at ");
  page.holds("Printed flat: 4 × 4 cells of 10&nbsp;mm, 41&nbsp;mm × 41&nbsp;mm");
});
