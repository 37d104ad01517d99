// shared_browser.mjs start|stop FILE: one browser for all tests of a run of ctest. FILE contains its address meanwhile.
// A process in the background keeps the browser. Both end by `stop`, or with the process that called `start`.
import {spawn} from "node:child_process";
import {existsSync, readFileSync, renameSync, rmSync, writeFileSync} from "node:fs";
import {fileURLToPath} from "node:url";

const OWNER_MS = 1000, FILE_MS = 20;  // between two looks
const [task, file, owner] = process.argv.slice(2);

async function start() {
  await stop();  // of a run that was killed
  const keeper = spawn(process.execPath, [fileURLToPath(import.meta.url), "keep", file, process.ppid], {detached: true, stdio: "ignore"});
  keeper.once("exit", () => {
    console.error("the browser does not start");
    process.exit(1);
  });
  setInterval(() => existsSync(file) && process.exit(0), FILE_MS);
}

function ownerLives() {
  try {
    return process.kill(Number(owner), 0);
  } catch {
    return false;
  }
}

async function keep() {
  const {launchShared} = await import("./studio.mjs"), chrome = await launchShared();
  writeFileSync(`${file}.new`, JSON.stringify({endpoint: chrome.wsEndpoint()}));
  renameSync(`${file}.new`, file);
  chrome.once("disconnected", () => chrome.close().finally(() => process.exit(0)));
  setInterval(() => ownerLives() || chrome.close(), OWNER_MS);
}

async function stop() {
  if (!existsSync(file)) return;
  const {default: puppeteer} = await import("puppeteer-core");
  const {endpoint} = JSON.parse(readFileSync(file));
  rmSync(file);
  await puppeteer.connect({browserWSEndpoint: endpoint}).then((chrome) => chrome.close(), () => {});
}

await {start, keep, stop}[task]();
