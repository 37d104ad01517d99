// A report in the browser, and what its page says.
import assert from "node:assert/strict";
import {writeFileSync} from "node:fs";
import path from "node:path";
import {after, before} from "node:test";
import {pathToFileURL} from "node:url";
import {browser, drawn as framesAreDrawn, emptyPage, ended, folder} from "./studio.mjs";

const WIDTH = 600, HEIGHT = 600;  // CSS pixels
// The tests themselves cause some messages: drivers complain about reading pictures back, and a script may not fill the screen.
const CAUSED = /GL Driver Message|software WebGL|requestFullscreen/;

/** Uses the controls as a reader would, by keys too. A key goes to whatever has the focus, so that every control must
 *  keep it while it is used. Runs in the page. @returns what went wrong */
function useControls() {
  const faults = [];
  function keepsFocus(control, use) {
    control.focus();
    use();
    if (document.activeElement !== control) faults.push(`${control.outerHTML.slice(0, 80)} loses the focus`);
  }
  function press(key) {
    document.activeElement.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true}));
  }
  Object.defineProperty(navigator, "clipboard", {value: undefined, configurable: true});  // so that copying is done at once
  for (const slider of document.querySelectorAll("input[type=range]"))
    keepsFocus(slider, () => { slider.value = 1; slider.dispatchEvent(new Event("input")); });
  for (const control of document.querySelectorAll("button, input[type=radio], summary")) keepsFocus(control, () => control.click());
  for (const canvas of document.querySelectorAll("canvas"))
    keepsFocus(canvas, () => ["ArrowLeft", "ArrowLeft", "ArrowUp", "ArrowRight", "ArrowUp", "ArrowDown"].forEach((key, k) => {
      const before = canvas.toDataURL();
      press(key);
      if (canvas.toDataURL() === before) faults.push(`key press ${k + 1} does not turn the view`);
    }));
  window.dispatchEvent(new Event("beforeprint"));
  window.dispatchEvent(new Event("afterprint"));
  return faults;
}

/** Ends what useControls has begun. Runs in the page. */
function stop() {
  for (const button of document.querySelectorAll("button")) if (/^Stop/.test(button.textContent)) button.click();
}

class ReportPage {
  work = folder();

  async start(chrome) {
    this.page = await emptyPage(chrome, WIDTH, HEIGHT);
    this.page.on("console", (message) => CAUSED.test(message.text()) || this.messages.push(message.text()));
    for (const wrong of ["pageerror", "error"]) this.page.on(wrong, (error) => this.messages.push(String(error)));
  }

  /** Opens a report and waits until all of it is there. */
  async open(file) {
    this.messages = [];
    await this.page.goto(pathToFileURL(file));
    await this.page.waitForFunction(() => document.documentElement.dataset.ready === "true");
    this.html = await this.page.content();
  }

  async openText(html) {
    const file = path.join(this.work, "given.html");
    writeFileSync(file, html);
    await this.open(file);
  }

  /** Uses the open report. Nothing may go wrong on the way. */
  async use() {
    assert.deepEqual(await this.page.evaluate(useControls), []);
    await framesAreDrawn(this.page);
    await this.page.evaluate(stop);
    assert.deepEqual(this.messages, [], "the browser's console is silent");
    this.html = await this.page.content();
    this.holds('<div id="problems" role="alert" hidden="">');
    this.lacks('class="missing"');
    this.unsaid("balance", "torn", "unrest", "afar", "nan");
  }

  /** Opens the report of a folder of results and uses it. */
  async draw(results) {
    await this.open(path.join(results, "report.html"));
    await this.use();
  }

  holds(text) {
    assert.ok(this.html.includes(text), `the page lacks ${text}`);
  }

  lacks(text) {
    const at = this.html.indexOf(text);
    assert.ok(at < 0, `the page shows: ${this.html.slice(at, at + 300)}`);
  }

  /** Checks that none of the words is in what the page says, whatever its scripts call things. */
  unsaid(...words) {
    const said = this.html.replace(/<script[^]*?<\/script>|<style[^]*?<\/style>/g, "").replace(/"data:[^"]*"/g, "");
    for (const word of words) assert.doesNotMatch(said, new RegExp(`.{0,30}\\b${word}\\b.{0,10}`, "i"), `the page says ${word}`);
  }

  section(id) {
    return this.html.replaceAll("\n", " ").split(/(?=<section id=)/).find((part) => part.startsWith(`<section id="${id}"`));
  }

  /** Checks that the text occurs between the start of the section and the next one. */
  drawn(id, text) {
    assert.ok(this.section(id)?.includes(text), `section ${id} lacks ${text}`);
  }

  absent(id) {
    assert.equal(this.section(id), undefined, `there is a section ${id}`);
  }
}

/** The page of all tests of one process. */
export const page = new ReportPage();
let chrome;

before(async () => {
  chrome = await browser();
  await page.start(chrome);
});
after(() => chrome?.close());

/** Runs the program to its end, which must be the exit code, or one of several. */
export async function runs(codes, ...args) {
  const {code, errors} = await ended(...args);
  assert.ok([codes].flat().includes(code), `${args.join(" ")} ends with ${code}: ${errors}`);
}
