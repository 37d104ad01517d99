// Every script names what exists, and uses what it names: esbuild and browsers notice a name that is missing only when it is reached.
import assert from "node:assert/strict";
import path from "node:path";
import test from "node:test";
import js from "@eslint/js";
import {ESLint} from "eslint";
import globals from "globals";

/** Returns the faults that ESLint finds in files, one line each. */
async function faults(cwd, files, languageOptions, rules = {}) {
  const eslint = new ESLint({cwd, overrideConfigFile: true, baseConfig: [js.configs.recommended, {languageOptions, rules}]});
  const results = await eslint.lintFiles(files);
  assert.ok(results.length > 0);
  return results.flatMap(({filePath, messages}) =>
    messages.map(({line, message}) => `${path.relative(cwd, filePath)}:${line}: ${message}`));
}

test("the studio's scripts", async () => {
  assert.deepEqual(await faults(process.env.KINETIX_SOURCES, ["app/viewer/src/**/*.js"], {globals: globals.browser}), []);
});

test("the reports' scripts, page by page as browsers read them", async () => {
  // The three-dimensional view is a separate script.
  const names = {...globals.browser, KinetixScene: "readonly"};
  const inPage = (page, rules) => faults(process.env.KINETIX_PAGES, [page], {sourceType: "script", globals: names}, rules);
  assert.deepEqual(await inPage("page.js"), []);
  // A sweep's page shares scripts with the report, and does not call all that is in them.
  assert.deepEqual(await inPage("sweep_page.js", {"no-unused-vars": "off"}), []);
});

test("the tests' own scripts", async () => {
  const names = {...globals.node, ...globals.browser};
  assert.deepEqual(await faults(process.env.KINETIX_SOURCES, ["tests/viewer/*.mjs", "tests/report/*.mjs", "app/viewer/*.mjs"], {globals: names}), []);
});
