// SPDX-License-Identifier: BSD-3-Clause
// node build.mjs --outdir=DIR: viewer.js, viewer.css and the template index.html.

import { copyFileSync, mkdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const argument = process.argv.find((text) => text.startsWith("--outdir="));
const outdir = argument === undefined ? join(here, "build") : argument.slice("--outdir=".length);
mkdirSync(outdir, { recursive: true });

// A page holds three, whose licence goes with every copy of it.
const three = dirname(dirname(createRequire(import.meta.url).resolve("three")));
const license = readFileSync(join(three, "LICENSE"), "utf8").trim();

await build({
  entryPoints: { viewer: join(here, "src/main.ts") },
  absWorkingDir: here,
  outdir,
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2020",
  charset: "ascii",
  legalComments: "eof",
  footer: { js: `/*! three.js\n${license}\n*/` },
  logLevel: "warning",
});
copyFileSync(join(here, "src/index.html"), join(outdir, "index.html"));

// The page carries the bundle inline: nothing in it may end the element around it.
for (const [file, end] of [
  ["viewer.js", "</script"],
  ["viewer.js", "<!--"],
  ["viewer.css", "</style"],
]) {
  if (readFileSync(join(outdir, file), "utf8").toLowerCase().includes(end)) {
    console.error(`${file} holds ${end}, which would break the page`);
    process.exit(1);
  }
}
