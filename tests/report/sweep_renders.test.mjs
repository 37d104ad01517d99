// The reports of small sweeps of each kind of analysis in the browser.
import assert from "node:assert/strict";
import {statSync, writeFileSync} from "node:fs";
import path from "node:path";
import {before, test} from "node:test";
import {folder} from "./studio.mjs";
import {page, runs} from "./report_page.mjs";

const MOST_BYTES = 150000;  // of the page of 11 factors
const home = folder();

before(() => {
  writeFileSync(path.join(home, "crease.yaml"), "kinetix: 1\nstructure: {cells: [3, 1], cell_mm: 10}\ndesign: {theta_deg: 45}\n");
  writeFileSync(path.join(home, "cell.yaml"), "kinetix: 1\nstructure: {cells: [1, 1], cell_mm: 10}\ndesign: {theta_deg: 45}\n");
});

/** Runs a sweep of the crease, unless it has another base, and draws its report. */
async function draw(name, lines, base = "crease.yaml") {
  const file = path.join(home, `${name}.yaml`), out = path.join(home, name);
  writeFileSync(file, ["kinetix: 1", `base: ${base}`, ...lines, ""].join("\n"));
  await runs(0, "sweep", file, "-o", out, "--quiet");
  await page.draw(out);
}

/** Draws the report of a sweep of two angles. */
async function sweep(name, method) {
  await draw(name, [`method: ${method}`, "factors:", '  - {path: "design.columns[1].beta_deg", range: [5, 60]}', "  - {path: design.theta_deg, range: [10, 40]}",
    "responses: [fold_deg, end_mm]"]);
  page.holds('id="headline"');
  page.drawn("factors", "beta, column 1");
  page.drawn("responses", "end");
  page.drawn("response-0", 'class="model"');
  page.drawn("response-0", 'class="cloud"');
  page.drawn("provenance", "seed");
  page.absent("failures");
}

test("a random sweep has ranges and the shares of its factors", async () => {
  await sweep("lhs", "{kind: lhs, samples: 200}");
  page.holds("All 200 samples were computed");
  page.drawn("response-0", "standardised");
  page.holds("in 90 of 100 samples");
  page.holds("Most of it goes with beta, column 1");
  page.holds("the middle, and the limits of 90 of 100 samples");
});

test("an analysis of variances has total indices", async () => {
  await sweep("saltelli", "{kind: saltelli, samples: 64}");
  page.drawn("response-0", "total index");
  page.drawn("response-0", 'class="turn"');
});

test("a screening has elementary effects", async () => {
  await sweep("morris", "{kind: morris, samples: 10}");
  page.drawn("response-0", "elementary effect");
});

test("a sweep of one factor at a time has the largest changes", async () => {
  await sweep("one", "{kind: one_at_a_time, levels: 5}");
  page.drawn("response-1", "largest change");
  page.holds("in all 11 samples");
  page.drawn("response-0", "all else as in the first sample");
});

test("many factors of one kind are one row, and the sheet shows which wall counts", async () => {
  await draw("walls", ["method: {kind: monte_carlo, samples: 60}", "factors:", '  - {path: "design.walls[*].t_mm", normal: {mean: 0, sd: 0.05}, each: true, add: true}',
    '  - {path: "design.theta_deg", normal: {mean: 0, sd: 0.2}, add: true}', "model: equilibrium", "responses: [moved_rms_mm]"]);
  page.drawn("factors", "t, each wall");
  page.drawn("factors", "<td>10</td>");
  page.drawn("response-0", "t, each wall on the layout");
  page.drawn("response-0", "more of the factor raises the response");
  page.drawn("response-0", "more of it lowers the response");
  const bytes = statSync(path.join(home, "walls", "report.html")).size;
  assert.ok(bytes < MOST_BYTES, `${bytes} bytes`);
});

test("more samples than are shown one by one are all counted, and what multiplies the base has not the base's unit", async () => {
  await draw("scaled", ["method: {kind: factorial, levels: 50}", "factors:", "  - {path: structure.cell_mm, scale: true, range: [0.9, 1.1]}",
    "  - {path: design.theta_deg, add: true, range: [-5, 5]}", "responses: [end_mm]"]);
  page.drawn("factors", "0.9 to 1.1");
  page.drawn("factors", "times the base's");
  page.drawn("factors", "added to the base's");
  page.drawn("response-0", "samples, 2500 in all");
  page.drawn("response-0", "2000 of 2500 samples, drawn by lot");
});

test("factors of one kind with different values each are all listed", async () => {
  await draw("kinds", ["method: {kind: factorial, levels: 3}", "factors:", '  - {path: "design.columns[0].beta_deg", range: [0, 10]}',
    '  - {path: "design.columns[1].beta_deg", range: [-60, 5]}', "responses: [end_mm]"]);
  page.drawn("factors", "; -60 to 5");
});

test("samples that did not succeed are listed with the reason", async () => {
  await draw("bad", ["method: {kind: factorial}", "factors:", '  - {path: "design.walls[0].t", values: [0.5, 0.4]}', "responses: [fold_deg]"], "cell.yaml");
  page.drawn("failures", "no exact family");
  page.holds("1 of 2 samples did not succeed");
});
