// pictures.mjs FOLDER: the pictures of studio.md, the way of somebody who makes a bracelet and a letter. Not a test; run as
//   KINETIX_OPT=build/dev/bin/kinetix-opt node build/dev/tests/viewer/pictures.mjs docs/figures
import path from "node:path";
import {browser, folder, open, serve, wait} from "./studio.mjs";

const [target] = process.argv.slice(2), SIZE = {width: 1000, height: 640}, SETTLED = 1500;  // CSS pixels; ms
const chrome = await browser(), home = folder(), studio = await serve("", home), {page} = await open(chrome, studio.address, SIZE);

const shoot = async (name) => (await wait(SETTLED), page.screenshot({path: path.join(target, `${name}.png`)}));
const shown = (id) => page.waitForFunction((name) => !document.getElementById(name).hidden, {timeout: 120000}, id);
const search = async () => (await page.click("#search"), await wait(200), await shown("found"));

await page.click("#tab_goal");
await search();
await shoot("studio");
await page.click("#tab_make");
await page.click("#export button[type=submit]");
await shown("written");
await shoot("studio_export");
await page.click("#tab_goal");
await page.click('label:has(input[value="letter"])');
await search();
await shoot("studio_letter");
const before = await page.$eval("#written_folder", (node) => node.textContent);
await page.click("#tab_make");
await page.click("#export button[type=submit]");
await page.waitForFunction((folder) => document.getElementById("written_folder").textContent !== folder, {timeout: 120000}, before);
await shoot("studio_letter_export");
await page.click("#tab_design");
await page.click('label:has(input[value="bullet"])');
await page.evaluate(async () => {
  await window.kinetix.fix(0, true);
  window.kinetix.scene.orbit.view("slant");
  window.kinetix.scene.fit();
  const [x, y, z] = window.kinetix.poses()[60];
  await window.kinetix.drag(60, [x + 25, y - 15, z + 20]);
});
await shoot("studio_physics");
await chrome.close();
await studio.stop();
