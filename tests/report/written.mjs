// Reports of results that a test has changed, by the program write_report.
import assert from "node:assert/strict";
import {spawn} from "node:child_process";
import {readFileSync} from "node:fs";

export const SAMPLE = JSON.parse(readFileSync(process.env.KINETIX_SAMPLE));

/** Returns the report of a result. */
export function reportOf(result) {
  return new Promise((resolve, reject) => {
    const child = spawn(process.env.KINETIX_WRITE_REPORT), out = [];
    child.stdout.on("data", (data) => out.push(data));
    child.stderr.pipe(process.stderr);
    child.on("error", reject);
    child.on("close", (code) => {
      assert.equal(code, 0, `write_report ends with ${code}`);
      resolve(Buffer.concat(out).toString());
    });
    child.stdin.end(JSON.stringify(result));
  });
}
