// SPDX-License-Identifier: BSD-3-Clause
// node test/run.mjs unit | browser | fixture [DIR]: bundles the TypeScript and runs it.
// browser and fixture take the viewer's bundle from build/, or from --bundle=DIR.

import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const root = dirname(here);
const [what, ...rest] = process.argv.slice(2);
const bundleArgument = rest.find((text) => text.startsWith("--bundle="));
const viewerBundle = resolve(
  bundleArgument?.slice("--bundle=".length) ??
    process.env.GIGARAY_VIEWER_BUNDLE ??
    join(root, "build"),
);

function sources() {
  if (what === "fixture") return [join(here, "fixture/make.ts")];
  const folder = join(here, what);
  return readdirSync(folder)
    .filter((name) => name.endsWith(".test.ts"))
    .map((name) => join(folder, name));
}

if (!["unit", "browser", "fixture"].includes(what)) {
  console.error("usage: node test/run.mjs unit | browser | fixture [DIR] [--bundle=DIR]");
  process.exit(2);
}
// Beside node_modules, so that what stays outside the bundle is found.
const out = mkdtempSync(join(root, "build-test-"));
let status = 1;
try {
  const entryPoints = sources();
  await build({
    entryPoints,
    outdir: out,
    outExtension: { ".js": ".mjs" },
    bundle: true,
    platform: "node",
    format: "esm",
    target: "node18",
    external: ["playwright-core"],
    sourcemap: "inline",
    logLevel: "warning",
  });
  const scripts = readdirSync(out).map((name) => join(out, name));
  const folder = rest.find((text) => !text.startsWith("--")) ?? join(tmpdir(), "gigaray-viewer");
  const args =
    what === "fixture"
      ? [scripts[0], viewerBundle, folder]
      : ["--test", "--enable-source-maps", ...scripts];
  const env = { ...process.env, GIGARAY_VIEWER_BUNDLE: viewerBundle };
  status = spawnSync(process.execPath, args, { stdio: "inherit", env }).status ?? 1;
} finally {
  rmSync(out, { recursive: true });
}
process.exit(status);
