// The studio's program and a browser with its page, for tests.
import {spawn} from "node:child_process";
import path from "node:path";
import puppeteer from "puppeteer-core";
import {folder, PROGRAM} from "./program.mjs";

export {folder, PROGRAM, run, SHAPES} from "./program.mjs";

const BROWSER = process.env.CHROMIUM ?? "/usr/bin/chromium";
const SOFTWARE = ["--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"];

/** Returns {address, stop, kill} of `view SOURCE`, run in a separate folder, which also contains the unsaved state. */
export async function serve(source, cwd = folder()) {
  const child = spawn(PROGRAM, ["view", "--no-open", ...(source ? [source] : [])], {cwd, env: {...process.env, XDG_STATE_HOME: path.join(cwd, "state")}});
  child.stderr.resume();
  const address = await new Promise((resolve, reject) => {
    child.stdout.once("data", (data) => resolve(String(data).trim()));
    child.once("close", () => reject(new Error("the program ended")));
  });
  const ended = new Promise((resolve) => child.once("close", resolve));
  return {address, cwd, stop: () => child.kill("SIGINT") && ended, kill: () => child.kill("SIGKILL") && ended};
}

export function browser() {
  return puppeteer.launch({executablePath: BROWSER, args: SOFTWARE, protocolTimeout: 120000});
}

/** A page that has its first frame; what the browser complains about is in `complaints`. */
export async function open(chrome, address, {width = 1280, height = 800, media = []} = {}) {
  const page = await chrome.newPage(), complaints = [];
  page.on("console", (message) => ["error", "warn"].includes(message.type()) && !/GL Driver Message/.test(message.text()) && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("requestfailed", (request) => complaints.push(`not loaded: ${request.url()}`));
  await page.setViewport({width, height});
  if (media.length) await page.emulateMediaFeatures(media);
  await page.goto(address);
  await page.waitForFunction(() => Boolean(window.kinetix), {timeout: 30000});
  await page.evaluate(() => window.kinetix.ready);
  return {page, complaints};
}

export const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
