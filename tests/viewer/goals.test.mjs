// Cards of goals and ghosts in the studio's page: what each card asks the program for, and what stands beside its result.
import assert from "node:assert/strict";
import {readFileSync, writeFileSync} from "node:fs";
import path from "node:path";
import {after, before, test} from "node:test";
import {browser, drawn, folder, open, PATIENCE, run, serve, SHAPES} from "./studio.mjs";

const home = folder();
let chrome, studio, page, complaints;  // of the studio without a file, where each card begins anew

before(async () => {
  chrome = await browser();
  studio = await serve("", home);
  ({page, complaints} = await open(chrome, studio.address));
  await page.click("#tab_goal");
});
after(async () => {
  await chrome?.close();
  await studio?.stop();
  await beside?.studio.stop();
});

/** Chooses a card, with its first numbers. */
async function choose(card) {
  await page.click('#kinds label:has(input[value="file"])');
  await page.click(`#kinds label:has(input[value="${card}"])`);
}

/** A file for each card that takes one. */
const DROPS = {space_curve: "helix.csv", image: "qr_code.png", helmet: "headform.obj", file: "circle.yaml"};
const SIDE = 9, STEP_MM = 10, ROUND_MM = 120;  // of a cap of a sphere, as a mesh

function capFile() {
  const at = (k) => (k - (SIDE - 1) / 2) * STEP_MM, number = (i, j) => j * SIDE + i + 1, lines = [];
  for (let j = 0; j < SIDE; ++j) for (let i = 0; i < SIDE; ++i) lines.push(`v ${at(i)} ${at(j)} ${Math.sqrt(ROUND_MM ** 2 - at(i) ** 2 - at(j) ** 2)}`);
  for (let j = 0; j + 1 < SIDE; ++j) for (let i = 0; i + 1 < SIDE; ++i) lines.push(`f ${number(i, j)} ${number(i + 1, j)} ${number(i + 1, j + 1)} ${number(i, j + 1)}`);
  const file = path.join(folder(), "cap_mesh.obj");
  writeFileSync(file, lines.join("\n") + "\n");
  return file;
}
const fileFor = (card) => (card === "mesh" ? capFile() : path.join(SHAPES, DROPS[card]));

/** Draws an arch on the pad, as a hand does. */
async function drawOn() {
  const pad = await page.$("#goal .pad");
  await pad.evaluate((node) => node.scrollIntoView({block: "center"}));
  const {x, y, width, height} = await pad.boundingBox();
  const at = (k) => [x + width * (0.5 - 0.4 * Math.cos((Math.PI * k) / 12)), y + height * (0.85 - 0.6 * Math.sin((Math.PI * k) / 12))];
  await page.mouse.move(...at(0));
  await page.mouse.down();
  for (let k = 1; k <= 12; ++k) await page.mouse.move(...at(k), {steps: 2});
  await page.mouse.up();
}

/** Returns the output of `check` for a target with its files next to it. */
async function checked(name, text, file) {
  const beside = path.join(home, `${name}.yaml`);
  if (file) writeFileSync(path.join(home, path.basename(file)), readFileSync(file));
  writeFileSync(beside, text);
  return JSON.parse(await run("check", beside, "--json"));
}

test("every card asks for something that the program takes, by its first numbers", async () => {
  const cards = await page.$$eval('#kinds input', (all) => all.map(({value}) => value));
  assert.ok(cards.length >= 12, `cards: ${cards}`);
  for (const card of cards) {
    await choose(card);
    const drop = await page.$("#goal .drop input"), pad = await page.$("#goal .pad"), file = drop && !pad ? fileFor(card) : null;
    if (pad) await drawOn();
    else if (file) {
      await drop.uploadFile(file);
      await page.waitForFunction(() => document.getElementById("target_text").value !== "");
    }
    const text = await page.$eval("#target_text", ({value}) => value);
    const {valid, expected, kind} = await checked(card, text, file);
    assert.equal(valid, true, `${card}: ${text}`);
    assert.equal(kind, "target", card);
    assert.ok(expected.bodies > 3 && expected.flat_mm.every((mm) => mm > 0), `${card}: ${JSON.stringify(expected)}`);
  }
  assert.deepEqual(complaints, []);
});

test("a file or what is drawn: the later of the two is searched for, and named", async () => {
  const text = () => page.$eval("#target_text", ({value}) => value), label = () => page.$eval("#goal .drop .note", ({textContent}) => textContent);
  for (const card of ["outline", "curve"]) {
    await choose(card);
    const file = path.join(folder(), "rim.csv"), empty = await label();
    writeFileSync(file, "x,y\n0,0\n100,0\n100,80\n0,80\n");
    await drawOn();
    assert.match(await text(), /points: \[\[/, card);
    await (await page.$("#goal .drop input")).uploadFile(file);
    await page.waitForFunction(() => document.getElementById("target_text").value.includes('points: "rim.csv"'));
    assert.match(await label(), /rim\.csv/, card);
    await drawOn();
    assert.match(await text(), /points: \[\[/, card);
    assert.equal(await label(), empty, card);
  }
  assert.deepEqual(complaints, []);
});

test("the front of a vase is as wide as its field says", async () => {
  await choose("surface");
  await page.select('#goal select[name="shape"]', "vase");
  const text = await page.$eval("#target_text", ({value}) => value), of = (key) => Number(text.match(new RegExp(`${key}: ([0-9.]+)`))[1]);
  assert.ok(Math.abs(2 * of("radius_mm") * Math.sin((of("arc_deg") * Math.PI) / 360) - 100) < 0.01, text);
  assert.equal((await checked("vase", text)).valid, true, text);
  assert.deepEqual(complaints, []);
});

test("a card says what it lacks instead of searching", async () => {
  for (const [card, says] of [["curve", /Draw a line/], ["helmet", /Choose a file/], ["image", /Choose a file/]]) {
    await choose(card);
    await page.click("#search");
    assert.match(await page.$eval("#messages", ({textContent}) => textContent), says, card);
    assert.ok(!(await page.evaluate(() => window.kinetix.state.searching)), card);
  }
  assert.deepEqual(complaints, []);
});

test("a drawn arch is searched for, and stands beside what was found", async () => {
  await choose("curve");
  await drawOn();
  await page.click("#search");
  await page.waitForFunction(() => !document.getElementById("found").hidden);
  assert.match(await page.$eval("#found_title", ({textContent}) => textContent), /^Goal met/);
  const {off} = await ghostOf(page);
  assert.ok(off < 1, `the ghost is up to ${off} cell edges off`);
  await page.evaluate(() => window.kinetix.send("redo"));
  assert.match(await page.$eval("#found_title", ({textContent}) => textContent), /^Goal met, /, "nothing to redo");
  await page.evaluate(() => window.kinetix.setHinge(0, {t: 0.4}));
  await page.waitForFunction(() => /^Result of an earlier version/.test(document.getElementById("found_title").textContent));
  await page.evaluate(() => window.kinetix.send("undo"));
  await page.waitForFunction(() => document.getElementById("found_title").textContent.startsWith("Goal met, "));
  assert.deepEqual(complaints, []);
});

/**
 * Returns the ghost in the frame of the poses: its numbers of lines, triangles and pictures, its box and the thing's, mm. Also
 * returns its largest distance from the thing, cell edges, its points, and the poses.
 */
const ghostOf = (page) => page.evaluate(() => {
  const {scene, design} = window.kinetix, poses = window.kinetix.poses(), cell = design.structure.cell_mm;
  const counts = {lines: 0, triangles: 0, pictures: 0}, points = [];
  scene.goal.updateMatrix();
  for (const one of scene.goal.children) {
    const {array} = one.geometry.attributes.position, kind = one.isLine ? "lines" : one.material.map ? "pictures" : "triangles";
    counts[kind] += 1;
    for (let k = 0; k < array.length; k += 3) points.push(scene.goal.position.clone().fromArray(array, k).applyMatrix4(scene.goal.matrix).toArray());
  }
  const box = (all) => [0, 1, 2].map((k) => [Math.min(...all.map((p) => p[k])), Math.max(...all.map((p) => p[k]))]);
  const far = Math.max(...points.map((p) => Math.min(...poses.map((q) => Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2])))));
  return {...counts, off: far / cell, ghost: box(points), thing: box(poses), cell, points, poses};
});

let beside = null;  // {studio, page, complaints} of the results that were opened last

/** Opens a folder of results in a separate studio, once its ghost is there. @returns its page */
async function opened(place) {
  const last = beside, shown = await serve(place, home);
  beside = {studio: shown, ...(await open(chrome, shown.address, {tab: last}))};
  await last?.studio.stop();
  await beside.page.waitForFunction(() => window.kinetix.scene.goal.children.length > 0 && !document.getElementById("found").hidden);
  await beside.page.waitForFunction(() => {  // in equilibrium it goes there step by step
    const {frame, design} = window.kinetix;
    return frame.mode === "exact" || (Number.isFinite(frame.energy) && Math.abs(frame.theta - design.theta_rad) < 1e-4);
  });
  return beside.page;
}

/** Searches for a shipped target after a change of its text. @returns the folder of its results */
async function search(name, change = (text) => text) {
  const file = path.join(home, `${name}.yaml`), place = path.join(home, name);
  writeFileSync(file, change(readFileSync(path.join(SHAPES, `${name}.yaml`), "utf8")).replace(/(mesh|points): (\w+\.\w+)/, `$1: ${SHAPES}/$2`));
  await run(file, "--no-verify", "-o", place);
  return place;
}

/** Uses the ghost of what a search found. */
async function found(place, use) {
  await use(await ghostOf(await opened(await place)));
  assert.deepEqual(beside.complaints, []);
}

test("a goal that the simulation does not confirm is no good news", async () => {
  // Pins keep the closed form in equilibrium too.
  const pins = "hinge: {model: rotary, kind: pin, diameter_mm: 1, clearance_mm: 0.05}\n";
  const place = await search("helmet_rib", (text) => text + pins), file = path.join(place, "result.json");
  for (const [agrees, kind] of [[false, "bad"], [true, "good"]]) {
    const result = JSON.parse(readFileSync(file)), words = result.summary.title.replace("helmet_rib: ", "Result of an earlier search: ");
    writeFileSync(file, JSON.stringify({...result, verdict: {...result.verdict, agrees}}));
    const rib = await opened(place);
    assert.deepEqual(await rib.$eval("#found_title", ({textContent, className}) => [textContent, className]), [words, kind]);
    assert.deepEqual(beside.complaints, []);
  }
});

test("the ghost of a curve is a ribbon along the folded strip", async () => {
  const {lines, triangles, off} = await ghostOf(beside.page);
  assert.deepEqual([lines, triangles], [2, 1]);
  assert.ok(off < 1, `up to ${off} cell edges off`);
});

test("the ghost lies on the sheet in each mode", async () => {
  const {page: rib, complaints: wrong} = beside, {off} = await ghostOf(rib);
  for (const mode of ["equilibrium", "bullet", "exact"]) {
    await rib.evaluate((name) => window.kinetix.mode(name), mode);
    await rib.waitForFunction((name) => window.kinetix.frame?.mode === name, {}, mode);
    let now = Infinity;  // an equilibrium is found step by step, and physics settles
    for (const end = performance.now() + PATIENCE; now > off + 1 && performance.now() < end; await drawn(rib)) ({off: now} = await ghostOf(rib));
    assert.ok(now <= off + 1, `${mode}: up to ${now} cell edges off, ${off} in the closed form`);
  }
  assert.deepEqual(wrong, []);
});

test("the ghost of a box is the ideal solid, within the walls' middles", () => found(search("cube", (text) => text.replace("[4, 4, 4]", "[2, 2, 2]")), ({lines, ghost, thing, cell}) => {
  assert.ok(lines >= 6, `${lines} lines`);
  ghost.forEach((side, k) => side.forEach((mm, end) => assert.ok(Math.abs(mm - thing[k][end]) < 0.6 * cell, `axis ${k}: ${ghost[k]} beside ${thing[k]}`)));
}));

// Three ribs of large cells show the same as the whole helmet.
const FEW_RIBS = [["ribs: 8", "ribs: 3"], ["coverage_mm: 90", "coverage_mm: 70"], ["cell_mm: 6", "cell_mm: 24"]];

test("the ghost of a helmet is the head, where it is to the helmet in the result", () => found(search("headform", (text) => FEW_RIBS.reduce((now, [from, to]) => now.replace(from, to), text)), ({lines, points, poses}) => {
  assert.ok(lines > 5, `${lines} lines`);
  const {helmet: {head_mm, bare_mm}, states} = JSON.parse(readFileSync(path.join(home, "headform", "result.json"))), head = head_mm.flat();
  const bodies = states.find(({name}) => name === "target").poses.map(({position_mm}) => position_mm);
  const far = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  assert.equal(points.length, head.length + bare_mm.flat().length);
  for (let k = 0; k < head.length; k += 50)
    for (const share of [0, 0.1, 0.5, 1]) {
      const body = Math.floor(share * (bodies.length - 1));
      assert.ok(Math.abs(far(points[k], poses[body]) - far(head[k], bodies[body])) < 0.1, `point ${k}, body ${body}`);
    }
}));

test("the ghost of a letter is its picture under the panel", () => found(search("letter_t", (text) => text.replace("[10, 10]", "[8, 8]")), ({pictures, ghost, thing, cell}) => {
  assert.equal(pictures, 1);
  for (const k of [0, 1]) ghost[k].forEach((mm, end) => assert.ok(Math.abs(mm - thing[k][end]) < cell, `axis ${k}: ${ghost[k]} beside ${thing[k]}`));
}));
