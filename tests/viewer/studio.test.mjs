// The studio's page in a real browser, with the program that serves it.
import assert from "node:assert/strict";
import {existsSync} from "node:fs";
import path from "node:path";
import {after, before, test} from "node:test";
import {browser, folder, open, run, serve, SHAPES, wait} from "./studio.mjs";

const RIB_BODIES = 82;
let chrome, home, studio, page, complaints;

const theta = () => page.evaluate(() => window.kinetix.theta());
const text = (id) => page.$eval(`#${id}`, (node) => node.textContent);
const near = (value, expected, by, what) => assert.ok(Math.abs(value - expected) <= by, `${what}: ${value}, expected ${expected} within ${by}`);

before(async () => {
  home = folder();
  await run(path.join(SHAPES, "helmet_rib.yaml"), "--no-verify", "-o", path.join(home, "rib"));
  chrome = await browser();
  studio = await serve(path.join(home, "rib"), home);
  ({page, complaints} = await open(chrome, studio.address));
});

after(async () => {
  await chrome?.close();
  await studio?.stop();
});

test("the page loads with all bodies and without a complaint", async () => {
  assert.equal(await page.evaluate(() => window.kinetix.bodies), RIB_BODIES);
  const poses = await page.evaluate(() => window.kinetix.poses());
  assert.equal(poses.length, RIB_BODIES);
  assert.ok(poses.every((pose) => pose.length === 7 && pose.every(Number.isFinite)));
  assert.deepEqual(complaints, []);
});

test("the slider folds", async () => {
  await page.$eval("#theta", (slider) => {
    slider.value = 15;
    slider.dispatchEvent(new Event("input"));
  });
  await page.waitForFunction(() => Math.abs(window.kinetix.theta() - 15) < 0.1, {timeout: 5000});
  await page.evaluate(() => window.kinetix.setTheta(25));
  near(await theta(), 25, 1e-9, "theta");
});

test("the pointer drags a body along the one way that it has", async () => {
  await page.evaluate(() => window.kinetix.setTheta(20));
  await page.click('label:has(input[value="drag"])');
  const [x, y] = await page.evaluate(() => window.kinetix.onPage(80));
  const body = await page.evaluate(([a, b]) => window.kinetix.scene.pick(a, b)?.body ?? null, [x, y]);
  assert.notEqual(body, null, "there is a body under the pointer");
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 60, y, {steps: 6});
  await wait(300);
  await page.mouse.up();
  const moved = await theta();
  assert.ok(Math.abs(moved - 20) > 0.5, `theta moved from 20 to ${moved}`);
  await page.click('label:has(input[value="turn"])');
});

test("an edited tilt moves the page, and can be undone", async () => {
  const before = await page.evaluate(() => window.kinetix.poses());
  const ms = await page.evaluate(async () => {
    const start = performance.now();
    await window.kinetix.send("hinge", {indices: [0, 1], beta_deg: 0});
    return performance.now() - start;
  });
  assert.notDeepEqual(await page.evaluate(() => window.kinetix.poses()), before);
  console.log(`an edited tilt: ${ms.toFixed(0)} ms`);
  assert.equal(await page.$eval("#undo", (button) => button.disabled), false);
  await page.click("#undo");
  await page.waitForFunction(() => document.getElementById("undo").disabled);
});

test("a hinge that breaks the motion is marked, and the nearest exact design is a click away", async () => {
  const beta = await page.evaluate(() => (window.kinetix.design.structure.hinges[0].beta_rad * 180) / Math.PI);
  await page.evaluate((value) => window.kinetix.setHinge(0, {beta_deg: value + 15}), beta);
  await page.waitForFunction(() => window.kinetix.design.exact === false);
  assert.match(await text("verdict_text"), /not move/);
  assert.ok((await page.$$(".map .hinge.bad")).length > 0);
  await page.click("#nearest");
  await page.waitForFunction(() => window.kinetix.design.exact === true);
  assert.equal((await page.$$(".map .hinge.bad")).length, 0);
});

test("physics: drag, fix, pause", async () => {
  await page.evaluate(() => window.kinetix.mode("bullet"));
  await page.waitForFunction(() => window.kinetix.state.mode === "bullet");
  await page.evaluate(() => window.kinetix.fix(0, true));
  await page.waitForFunction(() => window.kinetix.state.fixed.includes(0));
  const [p, q] = await page.evaluate(() => [window.kinetix.poses()[0], window.kinetix.poses()[80]]);
  await page.evaluate((to) => window.kinetix.drag(80, to), [q[0] + 30, q[1], q[2] + 20]);
  await page.waitForFunction((x) => Math.abs(window.kinetix.poses()[80][0] - x) > 1, {timeout: 20000}, q[0]);
  const held = await page.evaluate(() => window.kinetix.poses()[0]);
  near(Math.hypot(held[0] - p[0], held[1] - p[1], held[2] - p[2]), 0, 0.5, "the fixed body stays");
  assert.equal(await text("reading_force"), "needs springs", "rigid hinges have no unit of force");
  await page.evaluate(() => window.kinetix.release());
  await page.click("#pause");
  await page.waitForFunction(() => window.kinetix.state.paused);
  await page.click("#pause");
  await page.evaluate(() => window.kinetix.mode("exact"));
});

test("it saves what simulate reads", async () => {
  await page.click("#save");
  await page.waitForFunction(() => !window.kinetix.design.unsaved);
  assert.ok(existsSync(path.join(home, "rib", "design.yaml")));
  assert.match(await text("messages"), /design\.yaml/);
});

test("by keys alone: tabs, the flat sheet, the scene", async () => {
  await page.evaluate(() => window.kinetix.setTheta(10));
  await page.focus("#scene");
  await page.keyboard.press("]");
  await page.waitForFunction(() => Math.abs(window.kinetix.theta() - 11) < 0.2, {timeout: 5000});
  await page.keyboard.press("n");
  assert.match(await text("status"), /^body \d+ of/);
  const before = await theta();
  for (let k = 0; k < 8; ++k) await page.keyboard.press("l");
  await wait(300);
  assert.notEqual(await theta(), before);
  await page.keyboard.press("Escape");
  await page.focus("#tab_design");
  await page.keyboard.press("ArrowRight");
  assert.equal(await page.$eval("#panel_goal", (panel) => panel.hidden), false);
  await page.keyboard.press("ArrowLeft");
  await page.$eval("#map svg", (picture) => picture.focus());
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("Enter");
  assert.equal(await page.$eval("#hinge", (form) => form.hidden), false);
});

test("everything that can be pressed has a name and can be reached", async () => {
  const nameless = await page.$$eval("button, input, select, textarea, canvas", (all) => all.filter((node) => {
    const label = node.labels?.length || node.getAttribute("aria-label") || node.textContent.trim() || node.title;
    return !label;
  }).map((node) => node.outerHTML.slice(0, 100)));
  assert.deepEqual(nameless, []);
});

test("a bracelet for a wrist of 170 mm, and its files", async () => {
  const fresh = await serve("", home), other = await open(chrome, fresh.address);
  await other.page.click("#tab_goal");
  await other.page.click("#search");
  await other.page.waitForFunction(() => !document.getElementById("found").hidden, {timeout: 90000});
  assert.match(await other.page.$eval("#found_title", (node) => node.textContent), /meets the goal/);
  await other.page.click("#tab_make");
  await other.page.click("#export button[type=submit]");
  await other.page.waitForFunction(() => !document.getElementById("written").hidden || document.querySelector("#messages p"), {timeout: 90000});
  const files = await other.page.$$eval("#written_files li", (items) => items.map((item) => item.textContent));
  assert.ok(files.some((name) => name.endsWith(".stl")), `written: ${files}`);
  assert.deepEqual(other.complaints, []);
  await other.page.close();
  await fresh.stop();
});

test("a letter that appears when pressed, and its files", async () => {
  const fresh = await serve("", folder()), other = await open(chrome, fresh.address), letter = other.page;
  await letter.click("#tab_goal");
  await letter.click('label:has(input[value="letter"])');
  await letter.click("#search");
  await letter.waitForFunction(() => !document.getElementById("found").hidden, {timeout: 90000});
  assert.match(await letter.$eval("#found_title", (node) => node.textContent), /meets the goal/);
  assert.equal(await letter.$eval("#colour", (select) => select.value), "light");
  const sizes = [];  // places of the bodies, let go and pressed
  for (const share of [0, 1]) {
    const deg = await letter.$eval("#theta", (slider, part) => {
      slider.value = Number(slider.min) + part * (Number(slider.max) - Number(slider.min));
      slider.dispatchEvent(new Event("input"));
      return Number(slider.value);
    }, share);
    await letter.waitForFunction((goal) => Math.abs(window.kinetix.theta() - goal) < 0.2, {timeout: 10000}, deg);
    sizes.push(await letter.evaluate(() => window.kinetix.poses().map(([x, y]) => [x, y])));
  }
  const reach = (points) => Math.max(...points.map(([x]) => x)) - Math.min(...points.map(([x]) => x));
  assert.ok(Math.abs(reach(sizes[1]) / reach(sizes[0]) - 1) > 0.02, "the slider presses it");
  await letter.click("#tab_make");
  await letter.click("#export button[type=submit]");
  await letter.waitForFunction(() => !document.getElementById("written").hidden || document.querySelector("#messages p"), {timeout: 90000});
  const files = await letter.$$eval("#written_files li", (items) => items.map((item) => item.textContent));
  assert.ok(files.some((name) => name.endsWith(".stl")), `written: ${files}`);
  assert.deepEqual(other.complaints, []);
  await letter.close();
  await fresh.stop();
});

test("on a page of 1000 pixels the tools take two rows, one beside the other's words", async () => {
  const other = await open(chrome, studio.address, {width: 1000, height: 640});
  const boxes = await other.page.$$eval(".tools, .corner, .corner > *", (all) => all.filter((node) => !node.hidden).map((node) => {
    const {left, right, top, bottom} = node.getBoundingClientRect();
    return {left, right, top, bottom};
  }));
  const [tools, corner, ...parts] = boxes;
  assert.ok(corner.top >= tools.bottom, "the view's row begins below the tools");
  assert.ok(corner.bottom - corner.top < 40, `one row: ${corner.bottom - corner.top} px`);
  assert.ok(parts.every(({left, right}, k) => left >= corner.left && right <= corner.right + 0.5 && (k === 0 || left >= parts[k - 1].right)), "nothing lies on its neighbour");
  await other.page.close();
});

test("a narrow screen, a dark one, and paper", async () => {
  const narrow = await open(chrome, studio.address, {width: 390, height: 800, media: [{name: "prefers-color-scheme", value: "dark"}]});
  assert.ok(await narrow.page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth));
  const [r, g, b] = await narrow.page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number));
  assert.ok(r + g + b < 150, "dark");
  const pdf = await narrow.page.pdf({format: "A4", printBackground: true});
  assert.ok(pdf.length > 10000);
  assert.deepEqual(narrow.complaints, []);
  await narrow.page.close();
});

test("no complaint was made on the way", () => assert.deepEqual(complaints, []));
