// Frame rates of both pages in a browser. The benchmarks read the lines that this script prints. It is not a test of the project,
// since the figures depend on the machine.
import assert from "node:assert/strict";
import {statSync} from "node:fs";
import path from "node:path";
import {after, before, test} from "node:test";
import {browser, folder, open, run, serve, SHAPES, wait} from "./studio.mjs";

const SECONDS = 5, BODY = 400, DRAGS = 50, RIB_BODY = 80, REACH_MM = 15, SLIDES = 30;
const home = folder();
let chrome;

before(async () => {
  for (const name of ["headform", "helmet_rib"]) await run(path.join(SHAPES, `${name}.yaml`), "--no-verify", "-o", path.join(home, name));
  chrome = await browser();
});
after(() => chrome?.close());

/** With a page of the studio for the result of that name. */
async function inStudio(name, use) {
  const studio = await serve(path.join(home, name), home);
  try {
    const {page} = await open(chrome, studio.address);
    await use(page);
    await page.close();
  } finally {
    await studio.stop();
  }
}

test("frames a second", () => inStudio("headform", async (page) => {
  const frames = () => page.evaluate(() => [window.kinetix.frames, performance.now()]);
  const bodies = await page.evaluate(() => window.kinetix.bodies);
  await page.evaluate(async (body) => {
    await window.kinetix.mode("bullet");
    const [x, y, z] = window.kinetix.poses()[body];
    await window.kinetix.drag(body, [x, y + 5, z + 20]);
  }, BODY);
  const [first, start] = await frames();
  await wait(1000 * SECONDS);
  const [last, end] = await frames();
  console.log(`drawn: ${(1000 * (last - first)) / (end - start)} frames a second, ${bodies} bodies`);
  assert.ok(last > first);
}));

test("from a drag to the animation frame that shows its effect", () => inStudio("helmet_rib", async (page) => {
  const times = await page.evaluate(async (body, drags, reach) => {
    const shown = () => new Promise((resolve) => requestAnimationFrame(resolve)), waits = [];
    await window.kinetix.mode("bullet");
    for (let k = 0; k < drags; ++k) {
      const [x, y, z] = window.kinetix.poses()[body], side = k % 2 ? -1 : 1, start = performance.now();
      await window.kinetix.drag(body, [x + side * reach, y, z + side * reach]);
      await shown();
      waits.push(performance.now() - start);
    }
    return waits.sort((a, b) => a - b);
  }, RIB_BODY, DRAGS, REACH_MM);
  assert.equal(times.length, DRAGS);
  console.log(`dragged: ${times[Math.floor(0.95 * (DRAGS - 1))]} ms, 95 of 100 of ${DRAGS} drags`);
}));

test("from opening a report to its first picture", async () => {
  const page = await chrome.newPage();
  await page.setViewport({width: 1100, height: 800});
  await page.evaluateOnNewDocument(() => {
    // The frame after the one in which the page is complete has been painted.
    const look = () => (document.documentElement?.dataset.ready === "true" ? requestAnimationFrame(() => (window.firstPicture = performance.now())) : requestAnimationFrame(look));
    requestAnimationFrame(look);
  });
  await page.goto(`file://${path.join(home, "headform", "report.html")}`);
  const ms = await (await page.waitForFunction(() => window.firstPicture, {timeout: 60000})).jsonValue();
  assert.ok(await page.evaluate(() => document.querySelectorAll(".first-shots svg path").length > 100));
  console.log(`pictured: ${ms} ms`);
  const UNDRAWN = 300;  // CSS pixels: as wide as a canvas is before anything is drawn on it
  await page.waitForFunction((width) => document.querySelector("#space .stage canvas").width !== width, {}, UNDRAWN);
  const most = await page.evaluate(async (steps) => {
    const slider = document.querySelector("#space .slider input"), times = [];
    for (let k = 0; k <= steps; ++k) {
      slider.value = (Number(slider.max) * k) / steps;
      const start = performance.now();
      slider.dispatchEvent(new Event("input"));
      times.push(performance.now() - start);
      await new Promise((resolve) => requestAnimationFrame(resolve));
    }
    return Math.max(...times);
  }, SLIDES);
  console.log(`slid: ${most} ms of script at most, ${SLIDES + 1} steps`);
  console.log(`written: ${Math.max(...["headform", "helmet_rib"].map((name) => statSync(path.join(home, name, "report.html")).size)) / 1e6} MB`);
  await page.close();
});
