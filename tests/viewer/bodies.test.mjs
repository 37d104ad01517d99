// The studio with an imported design of bodies, in a real browser.
import assert from "node:assert/strict";
import {writeFileSync} from "node:fs";
import path from "node:path";
import {after, before, test} from "node:test";
import {browser, emptyPage, folder, open, run, serve} from "./studio.mjs";

const WALL = 20, GAP = 1;  // mm: from hinge to hinge, and between two walls
let chrome, studio, page, complaints, out;

const text = (id) => page.$eval(`#${id}`, (node) => node.textContent);
const shown = (id) => page.$eval(`#${id}`, (node) => node.offsetParent !== null);
const place = (body) => page.evaluate((k) => window.kinetix.poses()[k].slice(0, 3), body);
const apart = (a, b) => Math.hypot(...a.map((v, k) => v - b[k]));

/** A box along x as an object of an OBJ file. @param first number of its first corner */
function box(name, material, from, to, first) {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((n) => [n & 1 ? to : from, n & 2 ? 0.4 : -0.4, n & 4 ? 3 : -3]);
  const faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
  return [`o ${name}`, `usemtl ${material}`, ...corners.map((p) => `v ${p.join(" ")}`), ...faces.map((face) => `f ${face.map((n) => n + first).join(" ")}`)].join("\n");
}

/** Three walls in a line, with a soft block between each two. */
function strip() {
  const parts = [0, 1, 2].map((k) => box(`wall_${k}`, "PLA", k * WALL + GAP / 2, (k + 1) * WALL - GAP / 2, 1 + 8 * k));
  parts.push(...[1, 2].map((k) => box(`joint_${k}`, "TPU", k * WALL - GAP / 2, k * WALL + GAP / 2, 17 + 8 * k)));
  return parts.join("\n") + "\n";
}

before(async () => {
  const home = folder(), model = path.join(home, "strip.obj");
  out = path.join(home, "out");
  writeFileSync(model, strip());
  await run("import", model, "--unit", "mm", "-o", out);
  chrome = await browser();
  studio = await serve(path.join(out, "design.yaml"), home);
  ({page, complaints} = await open(chrome, studio.address));
  await page.waitForFunction(() => window.kinetix.design.bodies && !window.kinetix.design.bodies.following);
});

after(async () => {
  await chrome?.close();
  await studio?.stop();
});

test("bodies and soft parts are drawn, and what is of sheets is not there", async () => {
  assert.equal(await page.evaluate(() => window.kinetix.bodies), 3);
  const drawn = await page.evaluate(() => window.kinetix.scene.pieces.map(({body, hinge, soft}) => [body, hinge ?? null, Boolean(soft)]));
  assert.deepEqual(drawn.slice(0, 3), [[0, null, false], [1, null, false], [2, null, false]]);
  assert.equal(drawn.filter(([, , soft]) => soft).length, 2);
  const share = await page.evaluate(async () => {
    const picture = await createImageBitmap(await window.kinetix.scene.picture()), canvas = new OffscreenCanvas(picture.width, picture.height), context = canvas.getContext("2d");
    context.drawImage(picture, 0, 0);
    const {data} = context.getImageData(0, 0, picture.width, picture.height);
    return data.filter((v, k) => k % 4 === 3 && v === 255).length / (data.length / 4);
  });
  assert.ok(share > 0.01, `of the canvas ${share} is drawn on`);
  for (const id of ["tab_goal", "sheet", "map", "made", "springs"]) assert.equal(await shown(id), false, id);
  for (const id of ["hinge_list", "play", "theta", "undo", "save", "tab_make"]) assert.equal(await shown(id), true, id);
  assert.deepEqual(complaints, []);
});

test("the slider turns the driven hinge by as much as it says", async () => {
  const {driven} = await page.evaluate(() => window.kinetix.design.bodies), [a, b] = await page.evaluate((k) => window.kinetix.design.structure.hinges[k].bodies, driven);
  const before = await place(b), other = await place(a);
  await page.$eval("#theta", (slider) => {
    slider.value = 90;
    slider.dispatchEvent(new Event("input"));
  });
  await page.waitForFunction(() => document.getElementById("reading_theta").textContent === "90\u00b0");
  assert.ok(Math.abs(apart(await place(a), await place(b)) - WALL / Math.SQRT2) < 0.01, "two walls at a right angle");
  assert.ok(apart(before, await place(b)) > 1 || apart(other, await place(a)) > 1, "a body moved");
});

test("a click reads a body, its hinges lead on, and another hinge is turned", async () => {
  const [x, y] = await page.evaluate(() => window.kinetix.onPage(2));
  await page.mouse.click(x, y);
  await page.waitForFunction(() => document.getElementById("chosen_title").textContent === window.kinetix.design.structure.bodies[2].name);
  await page.click("#chosen_rows button.link");
  const rows = await text("chosen_rows");
  assert.match(rows, /soft part/);
  assert.match(await text("stiffness"), /N mm\/rad/);
  const {driven} = await page.evaluate(() => window.kinetix.design.bodies), other = 1 - driven;
  await page.select("#hinge_list", String(other));
  await page.click("#turn_this");
  await page.waitForFunction((hinge) => window.kinetix.design.bodies.driven === hinge && window.kinetix.design.bodies.meets, {}, other);
  assert.match(await text("verdict_text"), /turns from \u22121\d\d\u00b0 to 1\d\d\u00b0 until bodies collide/);
});

test("a hinge is given another stiffness, and that is undone", async () => {
  const turn = () => page.evaluate(() => Number(document.getElementById("stiffness").elements.turn.value));
  await page.waitForFunction(() => document.getElementById("stiffness").offsetParent !== null);
  const before = await turn();
  await page.$eval('#stiffness [name="turn"]', (field) => {
    field.value = 12.5;
    field.dispatchEvent(new Event("change", {bubbles: true}));
  });
  await page.waitForFunction(() => window.kinetix.design.structure.hinges.some(({k}) => k.turn === 12.5) && !document.getElementById("unsaved").hidden);
  await page.click("#undo");
  await page.waitForFunction(() => window.kinetix.design.structure.hinges.every(({k}) => k.turn !== 12.5));
  assert.equal(await turn(), before);
});

test("its elastic hinges have a force and an energy", async () => {
  await page.click('label:has(input[value="equilibrium"])');
  await page.waitForFunction(() => window.kinetix.frame.mode === "equilibrium");
  await page.evaluate(() => window.kinetix.setTheta(10));
  await page.waitForFunction(() => window.kinetix.frame.energy > 0 && Math.abs(window.kinetix.theta() - 10) < 1e-4);
  await page.waitForFunction(() => / N mm$/.test(document.getElementById("reading_energy").textContent));
  assert.match(await text("reading_force"), / N$/);
  await page.waitForFunction(() => document.querySelector("#path svg"));
  assert.match(await text("path"), /20\u00b0/);
  await page.click("#save");
  await page.waitForFunction(() => document.getElementById("unsaved").hidden);
  assert.equal(await shown("path"), true, "the chart stays with a design of the same revision");
});

test("it is dragged in the physics", async () => {
  await page.click('label:has(input[value="bullet"])');
  await page.waitForFunction(() => window.kinetix.state.mode === "bullet");
  await page.evaluate(() => window.kinetix.fix(0, true));
  const before = await place(2);
  await page.evaluate((to) => window.kinetix.drag(2, to), [before[0] - 8, before[1] + 12, before[2]]);
  await page.waitForFunction((y) => window.kinetix.poses()[2][1] > y + 3, {}, before[1]);
  await page.evaluate(() => window.kinetix.release());
  assert.deepEqual(complaints, []);
});

test("the report of a run draws bodies and soft parts, at rest and moved", async () => {
  const results = path.join(out, "turned"), report = await emptyPage(chrome, 800, 600), errors = [];
  await run("simulate", path.join(out, "design.yaml"), "--model", "equilibrium", "--theta-deg", "10", "-o", results);
  report.on("pageerror", (error) => errors.push(String(error)));
  await report.goto(`file://${results}/report.html`);
  await report.waitForFunction(() => document.documentElement.dataset.ready === "true");
  const seen = await report.evaluate(() => ({
    faces: [...document.querySelectorAll(".first-shots .standing")].map((picture) => picture.children.length),
    facts: Object.fromEntries([...document.querySelectorAll(".first-facts div")].map((row) => [row.children[0].textContent, row.children[1].textContent])),
    sections: [...document.querySelectorAll("section[id]")].map(({id}) => id), slider: Boolean(document.querySelector("#space .slider input")),
  }));
  assert.equal(seen.faces.length, 2);
  for (const faces of seen.faces) assert.ok(faces >= 5 * 6 && faces <= 5 * 12, `${faces} of 60 triangles are seen`);
  assert.match(seen.facts.Bodies, /^3, with 2\shinges$/);
  assert.match(seen.facts["At rest"], /^59\.?\d* \u00d7 0\.80+ \u00d7 6/);
  assert.notEqual(seen.facts.Moved, seen.facts["At rest"]);
  assert.ok(seen.slider && seen.sections.includes("load") && !seen.sections.includes("layout"), seen.sections.join());
  assert.deepEqual(errors, []);
});
