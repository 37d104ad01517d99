// A report's tick is amber, with the reason, if the printed sheet is bad or its quality is not known.
import {test} from "node:test";
import {page} from "./report_page.mjs";
import {reportOf, SAMPLE} from "./written.mjs";

const PRINTS = {process: "fdm", designed_mm: 0.1, rms_mm: 0.2, p95_mm: 0.3, tolerance_mm: 0.4, confirmed: true, sources: [], can_be_printed: true, holds: true, why: []};
const OWN = {curve: null, target: {kind: "own", name: "handle"}, tolerance: {error: 0.1, verify: 0.02}};
const END = {walls: ["[[0, 0], [1, 0]]", "[[0, 1], [1, 1]]"]};
const RANGE = {low: {theta_rad: -0.5, contact_rad: null, walls: []}, high: {theta_rad: 0.6, contact_rad: 0.6000001, ...END}, left_out: 1};
const CERTIFIED = {design: {growth_mm: 0, ...RANGE}, printed: {growth_mm: 0.2, ...RANGE}, covers_theta: true};

/** Returns the sample's verdict, which is green by itself, with problems. @param flag the one that is false, if any */
function flagged(flag, ...problems) {
  return {verdict: {...SAMPLE.verdict, ...(flag ? {[flag]: false} : {}), problems: problems.map(([level, text]) => ({level, text}))}};
}

/** Opens the sample's report with more sections, and without its pictures, which take most of the time. */
async function openWith(sections) {
  const result = {...SAMPLE, ...sections};
  delete result.states;
  delete result.structure;
  await page.openText(await reportOf(result));
}

test("prints that stay apart are good", async () => {
  await openWith({as_made: PRINTS});
  page.holds('class="verdict good"');
  page.lacks(". Collisions of printed walls were not checked.");
  page.holds("These figures are estimates, not measurements.");
  await openWith({as_made: {...PRINTS, free_of_contact: null}});
  page.holds(". Collisions of printed walls were not checked.");
});

test("warnings make it unsure, and errors bad, with the reason", async () => {
  await openWith(flagged("", ["warning", "3 of 20 prints found no equilibrium"], ["warning", "printed walls may collide"]));
  page.holds('class="verdict unsure"');
  page.holds('<p class="why">Warning: 3 of 20 prints found no equilibrium</p><details class="warnings"><summary>1&nbsp;more warning</summary>');
  await openWith(flagged("printable", ["error", "a wall of 0.4 mm is less than fdm prints, 0.8 mm"]));
  page.holds('class="verdict bad"');
  page.holds('<p class="why">Error: a wall of 0.4 mm is less than fdm prints, 0.8 mm</p>');
  await openWith(flagged("reaches", ["error", "the hinge of wall 3 is strained by 0.7"]));
  page.holds('class="verdict bad"');
});

test("a simulation that disagrees makes it bad", async () => {
  await openWith({...flagged("agrees", ["error", "the simulation ends 2.7 mm (rms) from the model"]),
    metrics: {met: true, verified: false, verify_rms: 0.27, strain_max: 0.95, strain_allowed: 0.5}});
  page.holds('class="verdict bad"');
  page.holds("The simulated sheet settles ");
  page.holds('<p class="why">Error: the simulation ends 2.7 mm (rms) from the model</p>');
});

test("a goal in code is met or missed", async () => {
  const why = "the error is 5; at most 0.1 is allowed";
  await openWith({...OWN, ...flagged("met", ["error", why]), own: {residuals: [3, 4], reasons: [why]},
    metrics: {error: 5, met: false, verified: true, verify_rms: 0.001}});
  page.holds('class="verdict bad"');
  page.holds(`<p class="why">Error: ${why}</p>`);
  page.holds("Its error is 5.00, the root of the sum of squares of 2 numbers, and 0.1 is allowed.");
  page.holds('<th scope="col">fit error</th>');
  page.absent("errors");
  await openWith({...OWN, own: {residuals: [0.05]}, metrics: {error: 0.05, met: true, verified: true, verify_rms: 0.001}});
  page.holds('class="verdict good"');
});

test("a range that is free of contact is shown with its ends", async () => {
  await openWith({certified: {...CERTIFIED, covers_theta_printed: false}});
  page.holds("<h2>Collision-free range</h2>");
  page.holds("For positive angles it ends at walls [[0, 0], [1, 0]] and [[0, 1], [1, 1]], which collide at 34.4°.");
  page.holds("This state is inside");
  page.holds("pair of plates touches in the flat sheet");
  page.holds("This state is outside: walls may collide during folding");
});

test("nothing is proven of a state that has left the closed form", async () => {
  await openWith({certified: {...CERTIFIED, states_are_exact: false, states_have_left: true, covers_theta_printed: true}});
  page.holds("<h2>Collision-free range of the ideal motion</h2>");
  page.holds("<p>Collisions were not checked for this state: the elastic solution departs from the ideal motion");
  page.lacks("This state is inside");
  page.lacks(". Computed for ideal hinges; the elastic solution stays close to this motion.");
  await openWith({certified: {why_not: "its states are equilibria"}});
  page.holds("Collisions were not checked: its states are equilibria.");
});
