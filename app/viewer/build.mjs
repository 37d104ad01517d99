// Bundles the scripts: node build.mjs SOURCES OUTPUT, from a folder that holds node_modules.
import {build} from "esbuild";
import path from "node:path";

const [sources, output] = process.argv.slice(2);
// Targets Debian 12's Chromium and phones that are some years old.
const common = {bundle: true, minify: true, target: ["es2021"], legalComments: "none", nodePaths: [path.resolve("node_modules")]};
// The licence requires its notice in every copy.
const notice = "/* @license three.js, Copyright 2010-2025 Three.js Authors, SPDX-License-Identifier: MIT */";

await build({...common, entryPoints: [`${sources}/src/report_scene.js`], format: "iife", globalName: "KinetixScene", banner: {js: notice},
  outfile: `${output}/scene.js`});
await build({...common, entryPoints: [`${sources}/src/studio/main.js`], format: "iife", banner: {js: notice}, outfile: `${output}/studio.js`});
await build({...common, entryPoints: [`${sources}/studio.css`], outfile: `${output}/studio.css`});
