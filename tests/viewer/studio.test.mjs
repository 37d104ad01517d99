// The studio's page in a real browser, with the program that serves it.
import assert from "node:assert/strict";
import {existsSync} from "node:fs";
import path from "node:path";
import {after, before, test} from "node:test";
import {browser, folder, open, resize, run, serve, SHAPES} from "./studio.mjs";

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
  await page.waitForFunction(() => Math.abs(window.kinetix.theta() - 15) < 0.1);
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
  await page.waitForFunction(() => Math.abs(window.kinetix.theta() - 20) > 0.5);
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
  await page.waitForFunction((x) => Math.abs(window.kinetix.poses()[80][0] - x) > 1, {}, q[0]);
  const held = await page.evaluate(() => window.kinetix.poses()[0]);
  near(Math.hypot(held[0] - p[0], held[1] - p[1], held[2] - p[2]), 0, 0.5, "the fixed body stays");
  assert.equal(await text("reading_force"), "needs springs", "rigid hinges have no unit of force");
  await page.evaluate(() => window.kinetix.release());
  await page.click("#pause");
  await page.waitForFunction(() => window.kinetix.state.paused);
  await page.click("#pause");
  await page.evaluate(() => window.kinetix.mode("exact"));
});

test("a hinge is dragged along its wall and across it in one step that can be undone, and its mirror image with it", async () => {
  const hinges = () => page.evaluate(() => window.kinetix.design.structure.hinges.map(({t, offset_mm}) => [t, offset_mm]));
  const revision = () => page.evaluate(() => window.kinetix.design.revision);
  const before = await hinges(), start = await revision();
  const along = await page.evaluate(() => {
    const {hinges: all, bodies} = window.kinetix.design.structure;
    return all.findIndex(({bodies: [a, b]}) => Math.abs(bodies[a].position_mm[0] - bodies[b].position_mm[0]) > 1);
  });
  await page.select("#symmetry", "mirror_x");
  const drag = async (dx, dy) => {
    const spot = (await page.$$(".map .hinge"))[along];
    await spot.evaluate((node) => node.scrollIntoView({block: "center", inline: "center"}));
    const {x, y, width, height} = await spot.boundingBox(), [cx, cy] = [x + width / 2, y + height / 2];
    await page.mouse.move(cx, cy);
    await page.mouse.down();
    await page.mouse.move(cx + dx * width, cy - dy * height, {steps: 5});
    await page.mouse.up();
  };
  await drag(0.8, 0.8);
  await page.waitForFunction((last) => window.kinetix.design.revision > last, {}, start);
  assert.equal(await revision(), start + 1, "one drag, one step");
  const after = await hinges(), changed = after.map((_, k) => k).filter((k) => String(after[k]) !== String(before[k]));
  assert.ok(changed.includes(along) && changed.length <= 2, `changed: ${changed}`);
  assert.ok(Math.abs(after[along][0] - before[along][0]) > 0.05, `t ${after[along][0]}`);
  assert.ok(Math.abs(after[along][1]) > 0.1, `offset ${after[along][1]} mm`);
  await page.click("#undo");
  await page.waitForFunction((last) => window.kinetix.design.revision > last, {}, start + 1);
  assert.deepEqual(await hinges(), before);
  await page.select("#symmetry", "none");
});

test("an edited design has no distance from a goal", async () => {
  await page.select("#colour", "distance");
  assert.match(await text("status"), /known after a search/);
  await page.select("#colour", "plain");
});

test("it pushes on a plate, films, and compares with the design before", async () => {
  await page.evaluate(() => window.kinetix.mode("bullet"));
  await page.waitForFunction(() => window.kinetix.state.mode === "bullet");
  await page.evaluate(() => window.kinetix.fix(0, true));
  const from = await page.evaluate(() => window.kinetix.poses());
  await page.evaluate(() => {
    const {bodies} = window.kinetix.design.structure;
    return window.kinetix.send("push", {body: 80, at: bodies[80].position_mm.map((v, k) => v + (k === 0 ? 2 : 0)), force_N: 20});
  });
  await page.waitForFunction((start) => window.kinetix.poses().some(([x, y, z], k) => Math.hypot(x - start[k][0], y - start[k][1], z - start[k][2]) > 0.5), {}, from);
  await page.evaluate(() => window.kinetix.release());
  await page.evaluate(() => window.kinetix.mode("exact"));
  if (!(await page.$eval("#film", (button) => button.hidden))) {
    await page.click("#film");
    assert.equal(await text("film"), "Stop film");
    await page.evaluate(() => (URL.createObjectURL = (blob) => ((window.film = blob.size), "data:,")));
    await page.click("#film");  // at once, and nothing moves
    await page.waitForFunction(() => document.getElementById("film").textContent === "Start film");
    assert.ok((await page.evaluate(() => window.film)) > 1000, "a film of more than its header");
  }
  await page.click("#remember");
  await page.click("#compare");
  assert.equal(await page.$eval("#before_view", (view) => view.hidden), false);
  assert.ok(await page.$eval("#before", (canvas) => canvas.width > 50 && canvas.height > 50));
  await page.click("#compare");
  assert.equal(await page.$eval("#before_view", (view) => view.hidden), true);
});

test("it saves what simulate reads", async () => {
  await page.click("#save");
  await page.waitForFunction(() => !window.kinetix.design.unsaved);
  assert.ok(existsSync(path.join(home, "rib", "design.yaml")));
  await page.waitForFunction(() => /design\.yaml/.test(document.getElementById("messages").textContent));
});

test("by keys alone: tabs, the flat sheet, the scene", async () => {
  await page.evaluate(() => window.kinetix.setTheta(10));
  await page.focus("#scene");
  await page.keyboard.press("]");
  await page.waitForFunction(() => Math.abs(window.kinetix.theta() - 11) < 0.2);
  await page.keyboard.press("n");
  assert.match(await text("status"), /^body \d+ of/);
  const before = await theta();
  for (let k = 0; k < 8; ++k) await page.keyboard.press("l");
  await page.waitForFunction((deg) => window.kinetix.theta() !== deg, {}, before);
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

test("on a page of 1000 pixels the tools take two rows, one beside the other's words", async () => {
  await resize(page, 1000, 640);
  const boxes = await page.$$eval(".tools, .corner, .corner > *", (all) => all.filter((node) => !node.hidden).map((node) => {
    const {left, right, top, bottom} = node.getBoundingClientRect();
    return {left, right, top, bottom};
  }));
  const [tools, corner, ...parts] = boxes;
  assert.ok(corner.top >= tools.bottom, "the view's row begins below the tools");
  assert.ok(corner.bottom - corner.top < 40, `one row: ${corner.bottom - corner.top} px`);
  assert.ok(parts.every(({left, right}, k) => left >= corner.left && right <= corner.right + 0.5 && (k === 0 || left >= parts[k - 1].right)), "nothing lies on its neighbour");
});

test("a narrow screen, a dark one, and paper", async () => {
  await page.emulateMediaFeatures([{name: "prefers-color-scheme", value: "dark"}]);
  await resize(page, 390, 800);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth));
  const [r, g, b] = await page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number));
  assert.ok(r + g + b < 150, "dark");
  const pdf = await page.pdf({format: "A4", printBackground: true});
  assert.ok(pdf.length > 10000);
  assert.deepEqual(complaints, []);
});

test("no complaint was made on the way", () => assert.deepEqual(complaints, []));
