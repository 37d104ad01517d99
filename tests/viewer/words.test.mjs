// Tests of the page's messages about the present state. They vanish when they no longer hold, and name the saved design.
import assert from "node:assert/strict";
import {existsSync, mkdirSync, readFileSync, rmSync, writeFileSync} from "node:fs";
import path from "node:path";
import {after, before, test} from "node:test";
import {browser, folder, leave, open, serve} from "./studio.mjs";

const home = folder();
let chrome, studio, page, complaints;  // of the studio without a file, where each test begins with a template

before(async () => {
  chrome = await browser();
  studio = await serve("", home);
  ({page, complaints} = await open(chrome, studio.address));
});
after(async () => {
  await chrome?.close();
  await studio?.stop();
});

const send = (page, type, keys = {}) => page.evaluate((name, rest) => window.kinetix.send(name, rest).then(() => "done", ({message}) => message), type, keys);
const text = (page, id) => page.$eval(`#${id}`, ({textContent}) => textContent);
const news = (page) => page.$$eval("#messages p > span", (lines) => lines.map(({textContent}) => textContent));
const until = (page, condition, ...args) => page.waitForFunction(condition, {}, ...args);
const noNews = (page) => until(page, () => document.querySelectorAll("#messages p").length === 0);

/** Starts anew in the page, without news. */
async function begin(template) {
  await page.evaluate(() => document.querySelectorAll("#messages button").forEach((button) => button.click()));
  assert.equal(await send(page, "open", {template}), "done");
  assert.equal(await send(page, "mode", {mode: "exact"}), "done");
  await noNews(page);
}

test("an error goes when a command of its kind works", async () => {
  for (const [type, wrong, right, works] of [
    ["hinge", {index: 0, t: 0}, "hinge", {index: 0, t: 0.4}],
    ["paint", {cell: [-1, 0], on: true}, "paint", {cell: [0, 0], on: false}],
    ["theta", {deg: 1000}, "theta", {deg: 10}],
    ["drag", {body: -1, to: [0, 0, 0]}, "theta", {deg: 12}],
    ["export", {formats: ["doc"]}, "export", {formats: ["svg"]}],
  ]) {
    assert.notEqual(await send(page, type, wrong), "done", type);
    assert.equal((await news(page)).length, 1, type);
    assert.equal(await send(page, right, works), "done", right);
    await noNews(page);
  }
  const results = path.join(home, "results");
  rmSync(results, {recursive: true});
  writeFileSync(results, "a file in the place of the folder");
  await send(page, "open", {template: "strip"});
  assert.match(await send(page, "save"), /results/);
  await send(page, "hinge", {index: 0, t: 0.4});
  assert.equal((await news(page)).length, 1, "that it was not saved is as true as before");
  rmSync(results);
  assert.equal(await send(page, "save"), "done");
  await until(page, () => [...document.querySelectorAll("#messages p > span")].every(({textContent}) => /^Saved: /.test(textContent)));
  assert.deepEqual(complaints, []);
});

test("an error goes when what it was about is another design, or computed in another way", async () => {
  await begin("panel");
  assert.notEqual(await send(page, "snap"), "done");
  assert.equal((await news(page)).length, 1);
  await send(page, "mode", {mode: "bullet"});
  await noNews(page);
  await send(page, "mode", {mode: "exact"});
  assert.notEqual(await send(page, "nearest"), "done", "it has one degree of freedom already");
  assert.equal(await text(page, "status"), "", "what was refused is not said to be done");
  await send(page, "open", {template: "strip"});
  await noNews(page);
  await page.click("#pick_column");
  assert.match((await news(page))[0], /Choose a hinge/);
  await page.evaluate(() => document.querySelectorAll(".map .hinge")[0].dispatchEvent(new PointerEvent("pointerdown", {bubbles: true, button: 0, pointerId: 1, clientX: 0, clientY: 0})));
  await page.evaluate(() => document.getElementById("map").dispatchEvent(new PointerEvent("pointerup", {bubbles: true, button: 0, pointerId: 1, clientX: 0, clientY: 0})));
  await noNews(page);
  assert.deepEqual(complaints, []);
});

test("the line of status is of the design that is shown", async () => {
  await begin("panel");
  await send(page, "hinge", {index: 20, t: 0.4});
  await until(page, () => !document.getElementById("nearest").hidden);
  await page.click("#nearest");
  await until(page, () => document.getElementById("status").textContent === "now it has one degree of freedom");
  await page.click("#undo");
  await until(page, () => document.getElementById("status").textContent === "" && !document.getElementById("nearest").hidden);
  await page.$eval("#map svg", (picture) => picture.focus());
  await page.keyboard.press("Enter");
  await until(page, () => /taken away/.test(document.getElementById("status").textContent));
  await page.click("#undo");
  await until(page, () => document.getElementById("status").textContent === "");
  await page.focus("#scene");
  await page.keyboard.press("n");
  assert.match(await text(page, "status"), /^body 0 of/);
  await send(page, "open", {template: "strip"});
  await until(page, () => document.getElementById("status").textContent === "");
  await page.click('label:has(input[value="fix"])');
  await page.focus("#scene");
  await page.keyboard.press("n");
  await page.keyboard.press("x");
  await until(page, () => /is fixed/.test(document.getElementById("status").textContent));
  await send(page, "reset");
  await until(page, () => document.getElementById("status").textContent === "");
  assert.deepEqual(complaints, []);
});

/** Runs `use` in a studio with a separate folder; no error may occur in it. */
async function inStudio(source, use, place, end = "stop") {
  const shown = await serve(source, place);
  try {
    await open(chrome, shown.address, {tab: {page, complaints}});
    await use();
    assert.deepEqual(complaints, []);
    await leave(page);
  } finally {
    await shown[end]();
  }
}

const thetaOf = (file) => Number(/theta_deg: (\S+)/.exec(readFileSync(file, "utf8"))[1]);

test("Save takes the design, Save at this fold what is shown, and the page says which", () => {
  const place = folder(), file = path.join(place, "strip.yaml");
  writeFileSync(file, "kinetix: 1\nstructure: {cells: [8, 1], cell_mm: 10}\ndesign: {theta_deg: 20}\n");
  return inStudio(file, async () => {
    assert.equal(await text(page, "design_fold"), "design: 20\u00b0");
    await page.evaluate(() => window.kinetix.setTheta(35));
    await page.click("#save");
    await until(page, () => /Saved: .*strip\.yaml, folded as in the design, 20\u00b0, not as shown, 35\u00b0/.test(document.getElementById("messages").textContent));
    assert.equal(thetaOf(file), 20);
    await page.click("#save_fold");
    await until(page, () => /folded as it is shown, 35\u00b0/.test(document.getElementById("messages").textContent));
    assert.equal(thetaOf(file), 35);
    await until(page, () => document.getElementById("design_fold").textContent === "design: 35\u00b0");
    assert.equal(await page.evaluate(() => window.kinetix.design.unsaved), false);
    await page.click("#undo");
    await until(page, () => document.getElementById("design_fold").textContent === "design: 20\u00b0" && !document.getElementById("unsaved").hidden);
    await page.click("#tab_make");
    assert.deepEqual(await page.$$eval('#export select[name="folded"] option', (all) => all.map(({textContent}) => textContent)),
      ["as in the design (20\u00b0)", "as shown (35\u00b0)"]);
    await page.select('#export select[name="folded"]', "shown");
    await page.click('#formats input[value="3mf"]');
    await page.click("#export button[type=submit]");
    await until(page, () => !document.getElementById("written").hidden);
    assert.equal(await text(page, "written_fold"), "Folded as it was shown: 35\u00b0.");
    await send(page, "hinge", {indices: [0, 1], beta_deg: 5});
    await until(page, () => document.getElementById("written_title").textContent === "Written, of another design than that shown");
  }, place);
});

test("a studio that is killed opens where it was, and says so while it is so", async () => {
  const place = folder();
  mkdirSync(path.join(place, "results"));
  await inStudio("", async () => {
    await send(page, "sheet", {columns: 5, rows: 3});
    await send(page, "hinge", {index: 0, t: 0.3});
    assert.match(await page.$eval("#unsaved", ({title}) => title), /A copy is in .*state.kinetix.studio/);
  }, place, "kill");
  await inStudio("", async () => {
    assert.equal(await page.evaluate(() => window.kinetix.design.structure.cells.length), 15);
    assert.match((await news(page))[0], /were not saved when the studio ended/);
    await page.click("#undo");
    await noNews(page);
    assert.equal(await page.evaluate(() => window.kinetix.design.structure.cells.length), 64, "as it begins");
    await page.click("#redo");
    await until(page, () => window.kinetix.design.structure.cells.length === 15);
    await page.click("#save");
    await until(page, () => /Saved: .*results.panel.design\.yaml/.test(document.getElementById("messages").textContent));
  }, place, "kill");
  assert.ok(existsSync(path.join(place, "results", "panel", "design.yaml")));
  await inStudio("", async () => {
    assert.equal(await page.evaluate(() => window.kinetix.design.structure.cells.length), 64, "what was saved is in its file");
    await send(page, "sheet", {columns: 5, rows: 3});
  }, place);
  await inStudio("", async () => {
    assert.equal(await page.evaluate(() => window.kinetix.design.structure.cells.length), 64, "one that was ended begins anew");
  }, place);
});
