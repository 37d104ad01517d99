// The reports of a display, a fold and a helmet in the browser, each with its own tolerances.
import {writeFileSync} from "node:fs";
import path from "node:path";
import {test} from "node:test";
import {folder, SHAPES} from "./studio.mjs";
import {page, runs} from "./report_page.mjs";

const home = folder(), MET = 0, NOT_MET = 3;  // exit codes: whether the goal is met does not matter here

/** Searches for a target and draws its report. */
async function search(name, ...lines) {
  const file = path.join(home, `${name}.yaml`), out = path.join(home, name);
  writeFileSync(file, ["kinetix: 1", ...lines, ""].join("\n"));
  await runs([MET, NOT_MET], file, "--no-verify", "--quiet", "-o", out);
  await page.draw(out);
}

test("a display has its numbers beside what is required", async () => {
  await search("ring", 'target: {kind: display, rows: ["0000", "0110", "0110", "0000"]}', "tolerance: {auc: 0.96, contrast: 2.5, stretch: 0.13}",
    "solver: {starts: 1, max_evaluations: 20}");
  page.drawn("display", "letter and background cells distinguished in");
  page.holds("required at least 0.96");
  page.holds("required at least 2.5");
  page.holds("allowed 0.13");
});

test("a fold has its angles, and columns that its net does not fill", async () => {
  await search("box", "target: {kind: fold, box: [2, 1, 1]}", "tolerance: {angle_deg: 0.3, shape: 0.03}");
  page.drawn("fold", '<th scope="col">Required</th>');
  page.drawn("layout", "&nbsp;columns and ");
  page.holds("allowed 0.3");
  page.holds("allowed 0.03");
});

test("a display with elastomer hinges is shown within the limits of their strain, and without them", async () => {
  await search("soft", "target: {kind: display, glyph: T}", "structure: {cells: [8, 8], cell_mm: 20, wall_mm: {thickness: 2, height: 8}}",
    "hinge: {kind: block, material: tango, gap_mm: 2, thickness_mm: 1.2}", "tolerance: {strain: 0.25}");
  page.drawn("display", "within the limits");
  page.drawn("display", "without limits");
  page.drawn("display", "simulated in the elastic model");
});

test("a helmet has its distance from the head", async () => {
  await search("cap", `target: {kind: helmet, mesh: ${SHAPES}/headform.obj, ribs: 3, coverage_mm: 70}`, "structure: {cell_mm: 24}", "tolerance: {rms_mm: 1.7, max_mm: 7}");
  page.drawn("helmet", "Off its section, rms");
  page.holds("allowed 1.7");
  page.holds("allowed 7");
});
