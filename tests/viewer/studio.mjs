// The studio's program and a browser with its page, for tests.
import {spawn} from "node:child_process";
import {readFileSync} from "node:fs";
import path from "node:path";
import puppeteer from "puppeteer-core";
import {folder, PROGRAM} from "./program.mjs";

export {ended, folder, PROGRAM, run, SHAPES} from "./program.mjs";

export const PATIENCE = 240000;  // ms: a machine with more work than cores takes long, and no test is about time
const PIXELS = 0.5;  // of the screen, per CSS pixel: no test counts them, and each is computed in software
const OPTIONS = {executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", timeout: PATIENCE, protocolTimeout: PATIENCE};
const COMMON = ["--no-sandbox", "--disable-dev-shm-usage", "--enable-unsafe-swiftshader"];
const ALL_IN_SOFTWARE = ["--use-angle=swiftshader", "--ignore-gpu-blocklist"];  // as a graphics card would: also the page around the scene
const SCENES_IN_SOFTWARE = ["--disable-gpu"];                                   // takes half the time

const launch = (flags) => puppeteer.launch({...OPTIONS, args: [...COMMON, ...flags]});
export const launchShared = () => launch(SCENES_IN_SOFTWARE);

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

/**
 * Returns {newPage, close}: a separate profile in the browser that all tests share (shared_browser.mjs), or a browser for
 * this script alone.
 */
export async function browser() {
  const {endpoint} = process.env.KINETIX_BROWSER ? JSON.parse(readFileSync(process.env.KINETIX_BROWSER)) : {};
  const chrome = await (endpoint ? puppeteer.connect({browserWSEndpoint: endpoint, protocolTimeout: PATIENCE}) : launch(ALL_IN_SOFTWARE));
  const profile = await chrome.createBrowserContext({downloadBehavior: {policy: "deny"}}), session = await chrome.target().createCDPSession();
  // Each page has its window: pages behind others draw nothing.
  const newPage = async () => {
    const {targetId} = await session.send("Target.createTarget", {url: "about:blank", newWindow: true, browserContextId: profile.id});
    return (await profile.waitForTarget((target) => target._targetId === targetId)).page();
  };
  const close = async () => {
    await profile.close();
    await (endpoint ? chrome.disconnect() : chrome.close());
  };
  return {newPage, close};
}

/** An empty page that waits as long as a busy machine needs. */
export async function emptyPage(chrome, width, height) {
  const page = await chrome.newPage();
  page.setDefaultTimeout(PATIENCE);
  await resize(page, width, height);
  return page;
}

/** Sets the size in CSS pixels, and waits until the page is drawn so. */
export async function resize(page, width, height) {
  await page.setViewport({width, height, deviceScaleFactor: PIXELS});
  await page.waitForFunction((wide) => window.innerWidth === wide, {}, width);
  await drawn(page);
}

/**
 * Opens a studio. @param tab what an earlier call returned, to use again in half the time
 * @returns {page, complaints}: a page that has its first frame, and what the browser complains about
 */
export async function open(chrome, address, {width = 1280, height = 800, tab = null} = {}) {
  const {page, complaints} = tab ?? (await newTab(chrome, width, height));
  complaints.length = 0;
  await page.goto(address);
  await page.waitForFunction(() => Boolean(window.kinetix));
  await page.evaluate(() => window.kinetix.ready);
  return {page, complaints};
}

/** Returns a list that gets what the scripts of a page complain about. */
export function complaintsOf(page) {
  const complaints = [];
  page.on("console", (message) => ["error", "warn"].includes(message.type()) && !/GL Driver Message/.test(message.text()) && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(String(error)));
  return complaints;
}

async function newTab(chrome, width, height) {
  const page = await emptyPage(chrome, width, height), complaints = complaintsOf(page);
  page.on("requestfailed", (request) => complaints.push(`not loaded: ${request.url()}`));
  return {page, complaints};
}

/** Leaves a studio that is to end: its page would complain. */
export const leave = (page) => page.goto("about:blank");

/** Waits until the page has drawn all that it was asked to draw so far. */
export const drawn = (page) => page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));

/** Returns the lines of the verdict in the panel of goals. Runs in the page. */
export const foundText = (panel) => [panel.querySelector("h2"), ...panel.querySelectorAll("#found_text > dl > div")].map(({textContent}) => textContent);

export const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
