// The program, for tests that need no browser.
import {spawn} from "node:child_process";
import {mkdtempSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import path from "node:path";

export const PROGRAM = process.env.KINETIX_OPT;
export const SHAPES = process.env.KINETIX_SHAPES;

/** Runs the program to its end. @returns its exit code and what it wrote: {code, out, errors} */
export function ended(...args) {
  return new Promise((resolve, reject) => {
    const child = spawn(PROGRAM, args), out = [], errors = [];
    child.stdout.on("data", (data) => out.push(data));
    child.stderr.on("data", (data) => errors.push(data));
    child.on("error", reject);
    child.on("close", (code) => resolve({code, out: Buffer.concat(out).toString(), errors: Buffer.concat(errors).toString()}));
  });
}

/** Runs the program to its end. @returns what it wrote on standard output */
export const run = async (...args) => (await ended(...args)).out;

/** A folder that goes with the process. */
export function folder() {
  const made = mkdtempSync(path.join(tmpdir(), "kinetix-viewer-"));
  process.on("exit", () => rmSync(made, {recursive: true, force: true}));
  return made;
}
