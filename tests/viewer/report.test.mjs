// The report's view in space, in a real browser.
import assert from "node:assert/strict";
import {existsSync, readFileSync, statSync, writeFileSync} from "node:fs";
import path from "node:path";
import {after, before, test} from "node:test";
import {browser, complaintsOf, drawn, emptyPage, folder, resize, run, SHAPES} from "./studio.mjs";

const MOST_BYTES = 1.2e6;  // of a report
const WIDE = [1100, 800], NARROW = [390, 800];  // CSS pixels
const home = folder();
let chrome, page, complaints, shown;  // the name of the shape whose report the page shows

before(async () => {
  chrome = await browser();
  page = await emptyPage(chrome, ...WIDE);
  complaints = complaintsOf(page);
});
after(() => chrome?.close());

/** Returns the parts that a reader sees before scrolling: the picture, the sheet, one verdict, sizes. */
async function firstScreen() {
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

// Fewer cells and columns that show the same.
const SMALLER = {letter_t: ["[10, 10]", "[8, 8]"], cube: ["[4, 4, 4]", "[2, 2, 2]"], disc: ["[12, 12]", "[6, 6]"], helix: ["[96, 1]", "[32, 1]"], headform: ["cell_mm: 6", "cell_mm: 7.5"]};

/** The report of a shape, searched for once. @returns its file */
async function searched(name) {
  const target = path.join(home, `${name}.yaml`), out = path.join(home, name), file = path.join(out, "report.html");
  if (existsSync(file)) return file;
  const text = readFileSync(path.join(SHAPES, `${name}.yaml`), "utf8").replace(/(mesh|points): (\w+\.\w+)/, `$1: ${SHAPES}/$2`);
  writeFileSync(target, text.replace(...(SMALLER[name] ?? ["", ""])));
  await run(target, "--no-verify", "-o", out);
  return file;
}

/** Shows the report of a shape, unless it is there already. @returns its file */
async function report(name) {
  const file = await searched(name);
  if (shown === name) return file;
  shown = name;
  complaints.length = 0;
  await page.emulateMediaType("screen");
  await page.emulateMediaFeatures([]);
  await page.goto(`file://${file}`);
  await page.waitForFunction(() => document.documentElement.dataset.ready === "true");
  return file;
}

/** Returns whether the scene differs between the ends of its slider. The time of a step is in the benchmarks (frame_rate.test.mjs). */
async function sliderMoves() {
  const pictures = [], stage = await page.$("#space .stage canvas");
  for (const end of ["min", "max"]) {
    await page.$eval("#space .slider input", (slider, name) => {
      slider.value = slider[name];
      slider.dispatchEvent(new Event("input"));
    }, end);
    await drawn(page);
    pictures.push(await stage.screenshot());
  }
  return Buffer.compare(...pictures) !== 0;
}

test("the first screen shows the thing, its sheet, one sentence and sizes; details fold away", async () => {
  for (const [name, fact] of [["helmet_rib", "Shape"], ["cube", "Solid"], ["disc", "Flat"], ["letter_t", "Picture"]]) {
    await report(name);
    const seen = await firstScreen();
    assert.equal(seen.pictures, 2, name);
    assert.ok(seen.shapes > 100, `${name}: ${seen.shapes} shapes`);
    assert.ok(seen.bottom < 800, `${name}: ends at ${seen.bottom}`);
    for (const key of ["Flat", "Folded", "Sheet", fact]) assert.match(seen.facts[key], /\d/, `${name}: ${key}`);
    assert.ok(seen.verdict.length > 10);
    assert.equal(seen.details, false);
    assert.equal(seen.closed, false);
    await resize(page, ...NARROW);
    assert.ok((await firstScreen()).wide <= 0, `${name}: fits a narrow screen`);
    await resize(page, ...WIDE);
    assert.deepEqual(complaints, []);
  }
});

test("a letter: cells on the right side, and a slider of distance that blurs them", async () => {
  await report("letter_t");
  assert.match(await page.$eval(".verdict h2", (title) => title.textContent), /^Goal met, /);
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
});

test("a letter, which has no closed form under its plates, says that it goes between states", async () => {
  await report("letter_t");
  assert.match(await page.$eval("#space .note", (note) => note.textContent), /computed states/);
  await page.emulateMediaFeatures([{name: "prefers-color-scheme", value: "dark"}]);
  await drawn(page);
  assert.ok((await page.pdf({format: "A4", printBackground: true})).length > 20000);
  assert.deepEqual(complaints, []);
});

test("a helmet: a tilt for every cell, and its layout at 1:1 on pages of A4", async () => {
  await report("headform");
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
});

test("a helmet of 648 bodies: a report of moderate size, whose slider moves it", async () => {
  const bytes = statSync(await report("headform")).size;
  assert.ok(bytes < MOST_BYTES, `${bytes} bytes`);
  assert.ok(await sliderMoves());
  assert.deepEqual(complaints, []);
});

test("colours by tilt, turn and distance, and the name of what is clicked", async () => {
  await report("headform");
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
});

test("a curve in space: bars of columns lie within their axes, to their own side of 0", async () => {
  await report("helix");
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
});

test("on a phone no label lies on another or beyond its drawing", async () => {
  await resize(page, ...NARROW);
  for (const name of ["helmet_rib", "cube", "letter_t", "headform", "helix"]) {
    await report(name);
    await page.evaluate(() => document.querySelectorAll("details").forEach((box) => (box.open = true)));
    await drawn(page);
    assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll("main svg")].filter((drawing) => drawing.checkVisibility()).flatMap((drawing) => {
      const all = drawing.getBoundingClientRect(), labels = [...drawing.querySelectorAll("text")].map((label) => ({text: label.textContent, box: label.getBoundingClientRect()}));
      const beyond = labels.filter(({box}) => box.left < all.left - 1 || box.right > all.right + 1).map(({text}) => `${text} is cut`);
      const over = labels.flatMap(({text, box: a}, k) => labels.slice(k + 1).filter(({box: b}) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1.5 &&
        Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 4).map((other) => `${text} on ${other.text}`));
      return [...beyond, ...over];
    })), [], name);
  }
  await resize(page, ...WIDE);
});

test("the page scrolls over the scene; a picture has two pixels per CSS pixel, sizes and a clear background", async () => {
  await report("cube");
  await page.$eval("#space .stage canvas", (canvas) => canvas.scrollIntoView({block: "center"}));
  const box = await (await page.$("#space .stage canvas")).boundingBox(), before = await page.evaluate(() => window.scrollY);
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
  await page.mouse.wheel({deltaY: 100});
  await page.waitForFunction((top) => window.scrollY > top, {}, before);
  const seen = await page.evaluate(async () => {
    const whole = new Promise((resolve) => (URL.createObjectURL = (blob) => (resolve(blob), "data:,")));
    [...document.querySelectorAll("#space button")].find(({textContent}) => textContent === "Picture").click();
    const picture = await createImageBitmap(await whole), {width, height} = picture, context = new OffscreenCanvas(width, height).getContext("2d");
    context.drawImage(picture, 0, 0);
    const {data} = context.getImageData(0, 0, width, height), count = (is) => data.reduce((sum, v, k) => sum + (k % 4 === 3 && is(data[k - 3], data[k - 1], v) ? 1 : 0), 0) / (width * height);
    return {width, clear: count((r, b, a) => a === 0), warm: count((r, b, a) => a === 255 && r > b + 20), ink: count((r, b, a) => a === 255 && r < 60 && b < 60)};
  });
  assert.ok(Math.abs(seen.width - 2 * box.width) < 3, `${seen.width} pixels on ${box.width}`);
  assert.ok(seen.clear > 0.3 && seen.warm > 0.01 && seen.ink > 0.0002, JSON.stringify(seen));
  assert.deepEqual(complaints, []);
});

test("a strip: its size, its slider and what it says", async () => {
  const bytes = statSync(await report("helmet_rib")).size;
  assert.ok(bytes < MOST_BYTES, `${bytes} bytes`);
  assert.ok(await page.$("#space .stage canvas"), "the scene is there");
  assert.match(await page.$eval("#space .note", (note) => note.textContent), /analytic motion/);
  assert.ok(await sliderMoves());
  assert.deepEqual(complaints, []);
});

test("no heading is the last thing on a printed page", async () => {
  await report("helmet_rib");
  await page.emulateMediaType("print");
  const loose = await page.$$eval("h1, h2, h3, h4, legend, summary, caption", (all) => all.filter((node) => node.checkVisibility() && !["avoid", "avoid-page"].includes(getComputedStyle(node).breakAfter)).map((node) => node.outerHTML.slice(0, 80)));
  assert.deepEqual(loose, []);
});
