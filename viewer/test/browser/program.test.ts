// SPDX-License-Identifier: BSD-3-Clause
// The page with scenes that the program writes, held against what its other commands make of them.

import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import type { Browser, Page } from "playwright-core";
import { launch, pixels, set } from "./browser";

const PROGRAM = process.env.GIGARAY_PROGRAM;
const folder = mkdtempSync(join(tmpdir(), "gigaray-page-"));
let browser: Browser;

function program(...words: string[]): string {
  assert.ok(PROGRAM, "GIGARAY_PROGRAM names the program");
  return execFileSync(PROGRAM, words, {
    cwd: folder,
    encoding: "utf8",
    stdio: ["ignore", "pipe", "pipe"],
  });
}

/** Opens a page of the program and says what it asked for. */
async function open(url: string): Promise<{ page: Page; requests: string[] }> {
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  const requests: string[] = [];
  page.on("request", (request) => requests.push(request.url()));
  await page.goto(url);
  await page.waitForFunction(() => globalThis.gigaray !== undefined);
  await page.evaluate(() => gigaray.ready);
  return { page, requests };
}

/** RGBA of a picture file, decoded by the browser. */
async function decoded(page: Page, path: string): Promise<Uint8Array> {
  const url = `data:image/png;base64,${readFileSync(path).toString("base64")}`;
  const text = await page.evaluate(async (source) => {
    const picture = new Image();
    picture.src = source;
    await picture.decode();
    const canvas = new OffscreenCanvas(picture.width, picture.height);
    const context = canvas.getContext("2d")!;
    context.drawImage(picture, 0, 0);
    let bytes = "";
    for (const byte of context.getImageData(0, 0, picture.width, picture.height).data)
      bytes += String.fromCharCode(byte);
    return btoa(bytes);
  }, url);
  return new Uint8Array(Buffer.from(text, "base64"));
}

/** Values of a PFM, rows from the top. */
function readPfm(path: string): { width: number; height: number; values: Float32Array } {
  const bytes = readFileSync(path);
  const head = /^Pf\n(\d+) (\d+)\n(-?[\d.]+)\n/.exec(bytes.subarray(0, 64).toString("latin1"))!;
  const [width, height] = [Number(head[1]), Number(head[2])];
  assert.ok(Number(head[3]) < 0, "little endian");
  const values = new Float32Array(width * height);
  for (let v = 0; v < height; v++)
    for (let u = 0; u < width; u++)
      values[v * width + u] = bytes.readFloatLE(
        head[0].length + 4 * ((height - 1 - v) * width + u),
      );
  return { width, height, values };
}

const SCENES = [
  { name: "row", synth: ["garden", "--views", "9", "--width", "141", "--height", "97"] },
  { name: "grid", synth: ["planes", "--grid", "3x3", "--width", "93", "--height", "71"] },
  {
    name: "walk",
    synth: ["garden", "--path", "walk", "--views", "5", "--width", "120", "--height", "80"],
  },
];

before(async () => {
  browser = await launch();
  for (const { name, synth } of SCENES) {
    program("synth", ...synth, "-o", name);
    program("depth", name, "-o", `${name}_depth`);
    program("view", `${name}_depth`, "-o", `${name}.html`);
  }
});

after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true });
});

for (const { name } of SCENES) {
  test(`${name}: one file, nothing else is asked for`, async () => {
    const { page, requests } = await open(`file://${folder}/${name}.html`);
    assert.deepEqual(
      requests.filter((url) => !/^(blob|data):/.test(url)),
      [`file://${folder}/${name}.html`],
    );
    assert.equal(await page.title(), `${name}_depth`);
    await page.close();
  });

  test(`${name}: the mask is that of gigaray segment, by the line that the page shows`, async () => {
    const { page } = await open(`file://${folder}/${name}.html`);
    const { min, max } = await page.evaluate(() => gigaray.scene.value);
    for (const [far, near] of [
      [20000, 45000],
      [1, 33333],
      [30001, 65535],
    ]) {
      await set(page, { interval: { far, near }, intervalOn: true });
      const mask = await pixels(page, "mask");
      const line = (await page.locator("code", { hasText: "gigaray segment" }).textContent())!;
      const words = line.trim().split(/\s+/).slice(1);
      assert.ok(max > min);
      program(...words, "--unit", "disparity");
      const expected = await decoded(page, join(folder, "masks", "mask.png"));
      assert.deepEqual(
        mask.bytes.filter((_, i) => i % (mask.bytes.length / (mask.width * mask.height)) === 0),
        expected.filter((_, i) => i % 4 === 0),
        line,
      );
    }
    await page.close();
  });

  test(`${name}: the value of a pixel is that of the PFM`, async () => {
    const { page } = await open(`file://${folder}/${name}.html`);
    const pfm = readPfm(join(folder, `${name}_depth`, "disparity.pfm"));
    const { min, max } = await page.evaluate(() => gigaray.scene.value);
    const halfStep = ((max - min) / 65534) * 0.5001;
    for (const [u, v] of [
      [0, 0],
      [40, 30],
      [pfm.width - 1, pfm.height - 1],
      [17, 61],
    ] as const) {
      const shown = await page.evaluate(([x, y]) => gigaray.valueAt(x!, y!), [u, v]);
      const stored = pfm.values[v * pfm.width + u]!;
      if (Number.isNaN(stored)) assert.equal(shown?.value ?? null, null);
      else assert.ok(Math.abs(shown!.value! - stored) <= halfStep, `${shown!.value} ${stored}`);
    }
    await page.close();
  });

  test(`${name}: refocused as gigaray render --refocus, within what JPEG changes`, async () => {
    const { page } = await open(`file://${folder}/${name}.html`);
    const { min, max } = await page.evaluate(() => gigaray.scene.value);
    const focus = min + 0.6 * (max - min);
    program("render", `${name}_depth`, `--refocus=${focus}`, "--aperture", "2", "-o", "refocused");
    await set(page, { refocusOn: true, focus, aperture: 2 });
    const made = await pixels(page, "refocused");
    const expected = await decoded(page, join(folder, "refocused", "view.png"));
    assert.equal(made.bytes.length, expected.length);
    let sum = 0;
    let far = 0;
    for (let i = 0; i < expected.length; i++) {
      const error = Math.abs(made.bytes[i]! - expected[i]!);
      sum += error;
      if (error > 16) far++;
    }
    // Pictures of the page are JPEGs of quality 85.
    assert.ok(sum / expected.length < 3, `mean error ${sum / expected.length}`);
    assert.ok(far / expected.length < 0.01, `${far} of ${expected.length} are off by more than 16`);
    await page.close();
  });
}

test("a page is small", () => {
  for (const { name } of SCENES) assert.ok(statSync(join(folder, `${name}.html`)).size < 4e6);
});

test("the server answers the page's probes", async () => {
  assert.ok(PROGRAM);
  const server = spawn(PROGRAM, ["view", "row_depth"], {
    cwd: folder,
    stdio: ["ignore", "pipe", "ignore"],
  });
  try {
    const address = await new Promise<string>((resolve) => {
      server.stdout.once("data", (bytes: Buffer) => resolve(bytes.toString().trim()));
    });
    assert.match(address, /^http:\/\/127\.0\.0\.1:\d+\/$/);
    const { page, requests } = await open(address);
    const top = await page.evaluate(() => gigaray.scene.top_view);
    const answer = page.waitForResponse((response) => response.url().includes("/probe?"));
    await set(page, { picked: { view: top, u: 40, v: 30 } });
    const probe = await (await answer).json();
    assert.equal(probe.scores.length, probe.hypotheses.count);
    assert.ok(requests.every((url) => url.startsWith(address) || /^(blob|data):/.test(url)));
    await page.close();
  } finally {
    server.kill("SIGINT");
    await new Promise((resolve) => server.once("exit", resolve));
  }
  assert.equal(server.exitCode, 0);
});
