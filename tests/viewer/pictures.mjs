// pictures.mjs FOLDER: draws the pictures of the studio's pages, for a bracelet and a letter. It writes their texts to
// studio.json, and searches.test.mjs compares them with its runs. `make figures` runs it.
import {writeFileSync} from "node:fs";
import path from "node:path";
import {browser, folder, foundText, open, serve, wait} from "./studio.mjs";

const [target] = process.argv.slice(2), SIZE = {width: 1000, height: 640}, SETTLED = 1500;  // CSS pixels; ms
const chrome = await browser(), home = folder(), studio = await serve("", home), {page} = await open(chrome, studio.address, SIZE);
await page.setViewport({...SIZE, deviceScaleFactor: 1});
await page.reload();  // the scene takes the screen's pixels when it is made
await page.waitForFunction(() => Boolean(window.kinetix));
await page.evaluate(() => window.kinetix.ready);

const shoot = async (name) => (await wait(SETTLED), page.screenshot({path: path.join(target, `${name}.png`)}));
const shown = (id) => page.waitForFunction((name) => !document.getElementById(name).hidden, {timeout: 120000}, id);
const search = async () => (await page.click("#search"), await wait(200), await shown("found"));
const texts = {}, keepText = async (name) => (texts[name] = await page.$eval("#found", foundText));

await page.click("#tab_goal");
await search();
await keepText("bracelet");
await shoot("studio");
await page.click("#tab_make");
await page.click("#export button[type=submit]");
await shown("written");
await shoot("studio_export");
await page.click("#tab_goal");
await page.click('label:has(input[value="letter"])');
await search();
await keepText("letter");
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
writeFileSync(path.join(target, "studio.json"), JSON.stringify(texts, null, 2) + "\n");
await chrome.close();
await studio.stop();
