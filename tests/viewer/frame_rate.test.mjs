// How many frames a second the studio's page draws of a helmet in the live physics, with a drag on: a figure of the benchmarks, which
// read the line that it writes. No test of the project: it depends on the machine.
import assert from "node:assert/strict";
import path from "node:path";
import {test} from "node:test";
import {browser, folder, open, run, serve, SHAPES, wait} from "./studio.mjs";

const SECONDS = 5, BODY = 400;

test("frames a second", async () => {
  const home = folder();
  await run(path.join(SHAPES, "headform.yaml"), "--no-verify", "-o", path.join(home, "helmet"));
  const chrome = await browser(), studio = await serve(path.join(home, "helmet"), home);
  try {
    const {page} = await open(chrome, studio.address), frames = () => page.evaluate(() => [window.kinetix.frames, performance.now()]);
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
  } finally {
    await chrome.close();
    await studio.stop();
  }
});
