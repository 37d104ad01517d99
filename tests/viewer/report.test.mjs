// The report's view in space, in a real browser.
import assert from "node:assert/strict";
import {readFileSync} from "node:fs";
import path from "node:path";
import {after, before, test} from "node:test";
import {browser, folder, run, SHAPES, wait} from "./studio.mjs";

const MOST_BYTES = 1.2e6, MOST_MS = 16;  // of a report; of script, a step of the slider
const home = folder();
let chrome;

before(async () => (chrome = await browser()));
after(() => chrome?.close());

async function report(name) {
  const out = path.join(home, name);
  await run(path.join(SHAPES, `${name}.yaml`), "--no-verify", "-o", out);
  const page = await chrome.newPage(), complaints = [];
  page.on("console", (message) => ["error", "warn"].includes(message.type()) && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(String(error)));
  await page.setViewport({width: 1100, height: 800});
  await page.goto(`file://${out}/report.html`);
  await page.waitForFunction(() => document.documentElement.dataset.ready === "true");
  return {page, complaints, file: path.join(out, "report.html")};
}

/** Longest and mean time of a step of the slider over its whole range, ms. */
const steps = (page) => page.evaluate(async () => {
  const slider = document.querySelector("#space .slider input"), times = [];
  for (let k = 0; k <= 30; ++k) {
    slider.value = (Number(slider.max) * k) / 30;
    const start = performance.now();
    slider.dispatchEvent(new Event("input"));
    times.push(performance.now() - start);
    await new Promise((resolve) => requestAnimationFrame(resolve));
  }
  times.sort((a, b) => a - b);
  return {median: times[15], most: times[30]};
});

test("a strip: its size, its slider and what it says", async () => {
  const {page, complaints, file} = await report("helmet_rib"), bytes = readFileSync(file).length;
  assert.ok(bytes < MOST_BYTES, `${bytes} bytes`);
  assert.ok(await page.$("#space .stage canvas"), "the scene is there");
  assert.match(await page.$eval("#space .note", (note) => note.textContent), /closed form/);
  await steps(page);
  assert.deepEqual(complaints, []);
  await page.close();
});

test("a helmet of 844 bodies: a step of the slider takes at most 16 ms of script", async () => {
  const {page, complaints} = await report("headform"), {median, most} = await steps(page);
  console.log(`a step: median ${median.toFixed(1)} ms, most ${most.toFixed(1)} ms`);
  assert.ok(median < MOST_MS, `${median} ms`);
  assert.deepEqual(complaints, []);
  await page.close();
});

test("a letter, which has no closed form under its plates, says that it goes between states", async () => {
  const {page, complaints} = await report("letter_t");
  assert.match(await page.$eval("#space .note", (note) => note.textContent), /computed states/);
  await page.emulateMediaFeatures([{name: "prefers-color-scheme", value: "dark"}]);
  await wait(200);
  assert.ok((await page.pdf({format: "A4", printBackground: true})).length > 20000);
  assert.deepEqual(complaints, []);
  await page.close();
});
