// How things stand, without a browser.
import assert from "node:assert/strict";
import {test} from "node:test";
import {fitted} from "../../app/viewer/src/placement.js";
import {product, turned} from "../../app/viewer/src/quaternion.js";
import {standing, standOf} from "../../app/viewer/src/standing.js";

const IDENTITY = [1, 0, 0, 0], HALF = Math.SQRT1_2;
const posesOf = (bodies) => Float64Array.from(bodies.flat());
const close = (a, b) => a.forEach((v, k) => assert.ok(Math.abs(v - b[k]) < 1e-9, `${a} is not ${b}`));

/** A grid of n x n bodies in the plane z = 0, turned by q. */
const sheet = (n, q = IDENTITY) => Array.from({length: n * n}, (_, k) => [10 * (k % n), 10 * Math.floor(k / n), 0, ...q]);

test("a flat panel lies flat", () => {
  const poses = posesOf(sheet(4)), rest = sheet(4).map((body) => body.slice(0, 3));
  close(standing(standOf(poses, rest), poses)[2], [0, 0, 1]);
});

test("an arch stands on its ends, whichever way it is curled", () => {
  for (const side of [1, -1]) {
    const bodies = Array.from({length: 21}, (_, k) => {
      const angle = side * (k - 10) * 0.12, half = angle / 2, radius = 50;
      return [radius * Math.sin(Math.abs(angle)) * Math.sign(k - 10), 0, side * radius * (Math.cos(angle) - 1), Math.cos(half), 0, Math.sin(half), 0];
    });
    const poses = posesOf(bodies), rest = bodies.map((_, k) => [5 * k, 0, 0]);
    const up = standing(standOf(poses, rest), poses)[2], height = (k) => bodies[k].slice(0, 3).reduce((sum, v, i) => sum + v * up[i], 0);
    assert.ok(height(10) > height(0) + 1 && height(10) > height(20) + 1, `curled to side ${side}: up is ${up}`);
  }
});

test("an arch with a straight leg stands on its ends, not on the leg", () => {
  const leg = 8, bend = 0.13, bodies = [];
  let angle = 0.9, x = 0, z = 0;
  for (let k = 0; k < 32; ++k) {
    bodies.push([x, 0, z, Math.cos(-angle / 2), 0, Math.sin(-angle / 2), 0]);
    x += 10 * Math.cos(angle), z += 10 * Math.sin(angle);
    if (k >= leg) angle -= bend * (24 / (32 - leg)) * 0.6;
  }
  const poses = posesOf(bodies), rest = bodies.map((_, k) => [10 * k, 0, 0]);
  const up = standing(standOf(poses, rest), poses)[2], height = (k) => bodies[k].slice(0, 3).reduce((sum, v, i) => sum + v * up[i], 0);
  assert.ok(height(16) > height(0) + 5 && height(16) > height(31) + 5, `up is ${up}`);
});

test("a box stands on its base: the flat part in the middle of the sheet", () => {
  const wall = [HALF, 0, HALF, 0];  // a quarter turn about y
  const base = sheet(4), side = Array.from({length: 16}, (_, k) => [40, 10 * (k % 4), 10 + 10 * Math.floor(k / 4), ...wall]);
  const poses = posesOf([...base, ...side]), rest = [...base.map((body) => body.slice(0, 3)), ...side.map(([, y, z]) => [90 + z, y, 0])];
  const {bodies} = standOf(poses, rest);
  assert.equal(bodies.length, 16);
  const rows = standing(standOf(poses, rest), poses);
  for (const row of rows) assert.ok(Math.abs(Math.hypot(...row) - 1) < 1e-9);
});

test("rows of a standing are a rotation", () => {
  const q = [0.5, 0.5, 0.5, 0.5], poses = posesOf(sheet(4, q)), [x, y, up] = standing(standOf(poses, sheet(4).map((body) => body.slice(0, 3))), poses);
  const cross = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
  close(cross, up);
});

test("a shape is laid onto the same shape elsewhere, flat or not", () => {
  const turn = [0.5, 0.1, -0.7, Math.sqrt(1 - 0.25 - 0.01 - 0.49)], arch = Array.from({length: 9}, (_, k) => [10 * k, 3 * (k % 2), k * k, ...IDENTITY]);
  for (const bodies of [sheet(4), arch, sheet(4).slice(0, 4)]) {
    const moved = bodies.map((pose) => [...turned(turn, pose.slice(0, 3)).map((v, k) => v + 7 * k - 4), ...product(turn, pose.slice(3))]);
    const {turn: found, from, to} = fitted(posesOf(bodies), posesOf(moved), 10);
    bodies.forEach((pose, k) => close(turned(found, pose.slice(0, 3).map((v, i) => v - from[i])).map((v, i) => v + to[i]), moved[k].slice(0, 3)));
  }
});
