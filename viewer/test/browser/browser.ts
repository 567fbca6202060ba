// SPDX-License-Identifier: BSD-3-Clause

import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { tmpdir } from "node:os";
import { extname, join } from "node:path";
import { type Browser, chromium, type Page } from "playwright-core";
import type { Handle } from "../../src/handle";
import { type Fixture, type FixtureName, makeFixture } from "../fixture/scenes";
import { writeFolder, writePage } from "../fixture/write_page";

declare global {
  // The page's handle, as code that runs in the page sees it.
  var gigaray: Handle & { ready: Promise<void> };
}

/** The bundle under test. */
export const BUNDLE = process.env.GIGARAY_VIEWER_BUNDLE!;

/** Where Debian has it; GIGARAY_CHROMIUM names another one. */
const CHROMIUM = process.env.GIGARAY_CHROMIUM ?? "/usr/bin/chromium";

export async function launch(): Promise<Browser> {
  if (!existsSync(CHROMIUM)) {
    throw new Error(`${CHROMIUM} is missing: install the package chromium`);
  }
  return chromium.launch({
    executablePath: CHROMIUM,
    args: [
      "--headless=new",
      "--no-sandbox",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--disable-dev-shm-usage",
    ],
  });
}

/** A page with all that it asked for and complained about. */
export interface Opened {
  page: Page;
  fixture: Fixture;
  requests: string[];
  complaints: string[];
}

export class Pages {
  private readonly folder = mkdtempSync(join(tmpdir(), "gigaray-viewer-"));
  private count = 0;
  private readonly servers: Server[] = [];

  constructor(private readonly browser: Browser) {}

  /** Opens a scene from file://; `change` damages it before. */
  async open(
    kind: FixtureName,
    change: (fixture: Fixture) => void = () => {},
    prepare: (page: Page) => Promise<void> = async () => {},
  ): Promise<Opened> {
    const fixture = makeFixture(kind);
    change(fixture);
    const path = join(this.folder, `${this.count++}.html`);
    writePage(BUNDLE, path, fixture);
    return this.visit(`file://${path}`, fixture, prepare);
  }

  /** Opens the scene's folder from a server on the loopback. */
  async serve(kind: FixtureName, change: (fixture: Fixture) => void = () => {}): Promise<Opened> {
    const fixture = makeFixture(kind);
    change(fixture);
    const folder = join(this.folder, String(this.count++));
    writeFolder(BUNDLE, folder, fixture);
    const server = createServer((request, answer) => {
      const name = decodeURIComponent(new URL(request.url ?? "/", "http://x").pathname);
      const path = join(folder, name === "/" ? "index.html" : name);
      if (!existsSync(path)) {
        answer.writeHead(404).end();
        return;
      }
      const type = extname(path) === ".html" ? "text/html" : "application/octet-stream";
      answer.writeHead(200, { "content-type": type }).end(readFileSync(path));
    });
    this.servers.push(server);
    await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
    return this.visit(
      `http://127.0.0.1:${(server.address() as AddressInfo).port}/`,
      fixture,
      async () => {},
    );
  }

  async close(): Promise<void> {
    for (const server of this.servers) server.close();
    await this.browser.close();
    rmSync(this.folder, { recursive: true });
  }

  private async visit(
    url: string,
    fixture: Fixture,
    prepare: (page: Page) => Promise<void>,
  ): Promise<Opened> {
    const page = await this.browser.newPage({ viewport: { width: 1280, height: 720 } });
    const requests: string[] = [];
    const complaints: string[] = [];
    page.on("request", (request) => requests.push(request.url()));
    page.on("requestfailed", (request) => complaints.push(`failed: ${request.url()}`));
    page.on("pageerror", (error) => complaints.push(error.message));
    page.on("console", (message) => {
      if (["error", "warning"].includes(message.type())) complaints.push(message.text());
    });
    await prepare(page);
    await page.goto(url);
    await page.waitForFunction(() => globalThis.gigaray !== undefined);
    await page.evaluate(() => gigaray.ready.catch(() => {}));
    return { page, fixture, requests, complaints };
  }
}

/** What a read-back of the page holds. Bytes travel as numbers. */
export async function pixels(
  page: Page,
  what: "mask" | "refocused" | "shown",
): Promise<{ width: number; height: number; bytes: Uint8Array }> {
  const found = await page.evaluate(async (name) => {
    const { width, height, bytes } = await gigaray[name]();
    let text = "";
    for (const byte of bytes) text += String.fromCharCode(byte);
    return { width, height, base64: btoa(text) };
  }, what);
  return { ...found, bytes: new Uint8Array(Buffer.from(found.base64, "base64")) };
}

/** Sets fields of the state and waits until they are shown. */
export function set(page: Page, changes: object): Promise<void> {
  return page.evaluate((fields) => gigaray.set(fields), changes);
}
