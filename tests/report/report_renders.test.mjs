// All sections of a strip's report in the browser.
import {test} from "node:test";
import {page} from "./report_page.mjs";
import {reportOf, SAMPLE} from "./written.mjs";

async function draw(result) {
  await page.openText(await reportOf(result));
  await page.use();
}

test("all sections are drawn", async () => {
  await draw(SAMPLE);
  page.holds('id="headline"');
  page.holds("<h2>Goal met, printable with pin hinges, simulation agrees</h2>");
  page.holds("<dt>Shape</dt><dd>0.3 mm rms from the curve, 0.6 mm at most; limit 0.8 mm rms</dd>");
  page.lacks("<dt>Size</dt>");
  page.holds('id="folded"');
  page.drawn("layout", 'class="hinge"');
  page.drawn("layout", "the tilt of its front wall; from row to row the sign alternates.");
  page.drawn("space", "<canvas");
  page.drawn("errors", 'class="model"');
  page.drawn("errors", 'class="turn"');
  page.drawn("tilts", "<td>5</td>");
  page.drawn("search", 'class="start best"');
  page.drawn("fidelity", 'class="dot model"');
  page.drawn("plan", "cylindrical sheet");
});

test("walls that all lean to one side have no alternating sign", async () => {
  const result = structuredClone(SAMPLE);
  for (const hinge of result.structure.hinges) hinge.beta_rad = Math.abs(hinge.beta_rad);
  const one = {columns: 6, cell_mm: 10, theta_rad: 0.5, shape_rms: 0.01, as_made_rms_mm: null, allowed: false, chosen: false};
  result.curve.robust = [one, {...one, as_made_rms_mm: 0.5, allowed: true}, {...one, as_made_rms_mm: 0.4, allowed: true, chosen: true}];
  await draw(result);
  page.drawn("layout", "the tilt of its front wall.");
});

test("the plain search's design has prints that are not known, beside one that is chosen", () =>
  page.drawn("errors", "unknown for the design with the smallest nominal error."));
