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

/** Returns the parts that a reader sees before scrolling: the picture, the sheet, one verdict, sizes. */
async function firstScreen(page) {
  return page.evaluate(() => {
    const low = (selector) => Math.max(...[...document.querySelectorAll(selector)].map((node) => node.getBoundingClientRect().bottom));
    return {
      pictures: document.querySelectorAll(".first-shots svg").length, shapes: document.querySelectorAll(".first-shots svg path").length,
      facts: Object.fromEntries([...document.querySelectorAll(".first-facts div")].map((row) => [row.children[0].textContent, row.children[1].textContent])),
      verdict: document.querySelector(".verdict h2").textContent, bottom: low(".first-shots, .first-facts"), details: document.getElementById("details").open,
      closed: document.querySelector("#details #plan").checkVisibility(), wide: document.documentElement.scrollWidth - window.innerWidth,
    };
  });
}

const found = new Map();  // folders of results, by the shape's name

/** The folder of a shape's results, searched once. */
async function results(name) {
  const out = path.join(home, name);
  if (!found.has(name)) found.set(name, run(path.join(SHAPES, `${name}.yaml`), "--no-verify", "-o", out));
  await found.get(name);
  return out;
}

async function report(name) {
  const out = await results(name);
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

test("the first screen shows the thing, its sheet, one sentence and sizes; details fold away", async () => {
  for (const [name, fact] of [["helmet_rib", "Shape"], ["letter_t", "Picture"], ["cube", "Solid"], ["disc", "Flat"]]) {
    const {page, complaints} = await report(name), seen = await firstScreen(page);
    assert.equal(seen.pictures, 2, name);
    assert.ok(seen.shapes > 100, `${name}: ${seen.shapes} shapes`);
    assert.ok(seen.bottom < 800, `${name}: ends at ${seen.bottom}`);
    for (const key of ["Flat", "Folded", "Sheet", fact]) assert.match(seen.facts[key], /\d/, `${name}: ${key}`);
    assert.ok(seen.verdict.length > 10);
    assert.equal(seen.details, false);
    assert.equal(seen.closed, false);
    await page.setViewport({width: 390, height: 800});
    await wait(200);
    assert.ok((await firstScreen(page)).wide <= 0, `${name}: fits a narrow screen`);
    assert.deepEqual(complaints, []);
    await page.close();
  }
});

test("a letter: cells on the right side, and a slider of distance that blurs them", async () => {
  const {page} = await report("letter_t");
  assert.match(await page.$eval(".verdict h2", (title) => title.textContent), /all 100 cells on the right side/);
  const blur = (metres) => page.evaluate((value) => {
    const slider = document.querySelector("#distance input");
    slider.value = value;
    slider.dispatchEvent(new Event("input"));
    if (!document.querySelector("#distance .far").style.filter.startsWith('url("#far-blur")')) return null;
    return Number(document.querySelector("#far-blur feGaussianBlur").getAttribute("stdDeviation"));
  }, metres);
  const [near, far] = [await blur(0), await blur(50)];
  assert.equal(near, 0);
  assert.ok(far > 10, `${far} px`);
  await page.close();
});

test("a helmet: a tilt for every cell, and its layout at 1:1 on pages of A4", async () => {
  const {page} = await report("headform");
  await page.evaluate(() => document.querySelectorAll("#helmet details").forEach((box) => (box.open = true)));
  await page.waitForSelector("#helmet .page svg");
  const mm = await page.evaluate(() => {
    const hinges = document.querySelectorAll("#helmet .page:first-of-type circle"), frame = document.querySelector("#helmet .page svg").getBoundingClientRect();
    return {width: frame.width / (96 / 25.4), hinges: hinges.length};
  });
  assert.ok(Math.abs(mm.width - 180) < 0.1, `${mm.width} mm`);
  assert.ok(mm.hinges > 100);
  const tilts = await page.$$eval('[aria-label="Tilts of the ribs"] td', (cells) => cells.filter((cell) => /\d/.test(cell.textContent)).length);
  assert.ok(tilts > 300, `${tilts} tilts`);
  await page.close();
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
  const {page, complaints, file} = await report("headform"), {median, most} = await steps(page);
  const bytes = readFileSync(file).length;
  assert.ok(bytes < MOST_BYTES, `${bytes} bytes`);
  console.log(`a step: median ${median.toFixed(1)} ms, most ${most.toFixed(1)} ms`);
  assert.ok(median < MOST_MS, `${median} ms`);
  assert.deepEqual(complaints, []);
  await page.close();
});

test("colours by tilt, turn and distance, and the name of what is clicked", async () => {
  const {page, complaints} = await report("headform");
  const stage = "#space .stage canvas", key = () => page.$eval("#space .heat-key", (output) => output.textContent);
  const colours = await page.$$eval("#space .colours option", (options) => options.map(({value}) => value));
  for (const name of ["", "tilt", "turn", "error"]) assert.ok(colours.includes(name), `${name} of ${colours}`);
  await page.$eval(stage, (canvas) => canvas.scrollIntoView({block: "center"}));
  for (const name of ["tilt", "turn", "error"]) {
    await page.select("#space .colours", name);
    assert.match(await key(), /dark: [\d.]+/);
  }
  await page.select("#space .colours", "");
  assert.equal(await key(), "");
  const box = await (await page.$(stage)).boundingBox();
  for (let k = 0; k < 40 && !(await page.$eval("#space .named", (output) => output.textContent)); ++k)
    await page.mouse.click(box.x + box.width * (0.3 + 0.01 * k), box.y + box.height * 0.5);
  assert.match(await page.$eval("#space .named", (output) => output.textContent), /^body \d+, hinge \d+: tilt/);
  assert.deepEqual(complaints, []);
  await page.close();
});

test("no heading is the last thing on a printed page", async () => {
  const {page} = await report("helmet_rib");
  await page.emulateMediaType("print");
  const loose = await page.$$eval("h1, h2, h3, h4, legend, summary, caption", (all) => all.filter((node) => node.checkVisibility() && !["avoid", "avoid-page"].includes(getComputedStyle(node).breakAfter)).map((node) => node.outerHTML.slice(0, 80)));
  assert.deepEqual(loose, []);
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

test("a curve in space: bars of columns lie within their axes, to their own side of 0", async () => {
  const {page, complaints} = await report("helix");
  const charts = await page.evaluate(() => [...document.querySelectorAll("#space-errors svg")].slice(1).map((chart) => {
    const axis = chart.querySelector("path.axis").getBoundingClientRect().bottom, top = chart.getBoundingClientRect().top;
    const zero = chart.querySelector("path.zero").getBoundingClientRect().top, bars = [...chart.querySelectorAll("rect.turn")].map((bar) => bar.getBoundingClientRect());
    return {bars: bars.length, ticks: chart.querySelectorAll(".grid path").length, low: axis - Math.max(...bars.map(({bottom}) => bottom)),
      high: Math.min(...bars.map((bar) => bar.top)) - top, fromZero: Math.max(...bars.map((bar) => Math.min(Math.abs(bar.top - zero), Math.abs(bar.bottom - zero))))};
  }));
  assert.equal(charts.length, 2);
  for (const {bars, ticks, low, high, fromZero} of charts) {
    assert.ok(bars > 10 && ticks > 2, `${bars} bars, ${ticks} ticks`);
    assert.ok(low > -1 && high > 15 && fromZero < 1.5, `${low}, ${high}, ${fromZero} px`);
  }
  assert.deepEqual(complaints, []);
  await page.close();
});
