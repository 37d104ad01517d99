// Tests of the size that a person types for a printer's bed, without a browser.
import assert from "node:assert/strict";
import {test} from "node:test";
import {bedSides} from "../../app/viewer/src/studio/make_panel.js";

test("a bed is two lengths, none where none is given, and refused else", () => {
  for (const text of ["250, 210", "250x210", " 250 \u00d7 210 "]) assert.deepEqual(bedSides(text), {bed_mm: [250, 210]});
  for (const text of ["", "  "]) assert.deepEqual(bedSides(text), {});
  for (const text of ["0, 200", "200", "1.2.3, 4", "200,", "1, 2, 3", "-1, 5", "Infinity, 5"]) assert.equal(bedSides(text), null, text);
});
