// SPDX-License-Identifier: BSD-3-Clause

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import type { Page } from "playwright-core";
import { valueOfCode } from "../../src/math/codes";
import { codesOf } from "../fixture/encode";
import { CARD, FIXTURE_NAMES, type Fixture, HEIGHT, WIDTH } from "../fixture/scenes";
import { parallelView } from "../fixture/synthetic";
import { launch, Pages, pixels, set } from "./browser";
import { refocusTwin } from "./refocus_twin";

let pages: Pages;

before(async () => {
  pages = new Pages(await launch());
});

after(() => pages?.close());

/** Text of a description list's entry in a panel. */
function entry(page: Page, name: string): Promise<string | null> {
  return page.evaluate((term) => {
    const terms = [...document.querySelectorAll("dt")];
    return terms.find((dt) => dt.textContent === term)?.nextElementSibling?.textContent ?? null;
  }, name);
}

/** The place on the screen of a pixel of the picture. */
async function onScreen(page: Page, u: number, v: number): Promise<[number, number]> {
  const box = (await page.locator(".frame canvas").boundingBox())!;
  return [box.x + ((u + 0.5) / WIDTH) * box.width, box.y + ((v + 0.5) / HEIGHT) * box.height];
}

for (const kind of FIXTURE_NAMES) {
  test(`${kind}: opens from file:// and asks for nothing outside`, async () => {
    const { page, requests, complaints, fixture } = await pages.open(kind);
    assert.equal(await page.title(), fixture.scene.title);
    assert.equal(await page.getByRole("alert").count(), 0);
    await page.mouse.click(...(await onScreen(page, 70, 55)));
    await set(page, { overlay: "value", intervalOn: true, refocusOn: true, wipeOn: true });
    await set(page, { stage: "3D", points: "mesh" });
    await set(page, { stage: "3D", points: "all" });
    await page.waitForTimeout(300);
    const outside = requests.filter((url) => !/^(file|blob|data):/.test(url));
    assert.deepEqual(outside, []);
    assert.equal(requests.filter((url) => url.startsWith("file:")).length, 1);
    assert.deepEqual(complaints, []);
    await page.close();
  });

  test(`${kind}: at rest the picture itself is shown`, async () => {
    const { page, fixture } = await pages.open(kind);
    for (const view of [fixture.scene.top_view, 1]) {
      await page.evaluate((idx) => gigaray.show(idx), view);
      const { width, height, bytes } = await pixels(page, "shown");
      assert.deepEqual([width, height], [WIDTH, HEIGHT]);
      const rgb = bytes.filter((_, i) => i % 4 !== 3);
      assert.deepEqual(rgb, fixture.views[view]!.rgb);
    }
    await page.close();
  });

  test(`${kind}: the mask equals its codes`, async () => {
    const { page, fixture } = await pages.open(kind);
    const { scene, views } = fixture;
    const codes = codesOf(views[scene.top_view]!.values, scene.value);
    const found = [...new Set(codes)].filter((code) => code > 0);
    const [low, high] = [Math.min(...found), Math.max(...found)];
    for (const interval of [
      { far: 1, near: 65535 },
      { far: high, near: high },
      { far: low, near: low },
      { far: low + 1, near: high - 1 },
      { far: 1, near: low },
    ]) {
      await set(page, { interval });
      const mask = await pixels(page, "mask");
      const expected = Uint8Array.from(codes, (code) =>
        code >= interval.far && code <= interval.near ? 255 : 0,
      );
      assert.deepEqual(mask.bytes, expected, JSON.stringify(interval));
    }
    await page.close();
  });

  test(`${kind}: refocus is the mean in linear light of what the views see`, async () => {
    const { page, fixture } = await pages.open(kind);
    const { top_view: top, value } = fixture.scene;
    for (const [focus, aperture] of [
      [value.min + 0.3 * (value.max - value.min), 9],
      [value.min + 0.72 * (value.max - value.min), 1],
    ] as const) {
      await set(page, { focus, aperture, refocusOn: true });
      const { bytes } = await pixels(page, "refocused");
      const expected = refocusTwin(fixture, top, focus, aperture);
      // Half a code of rounding, and a little for 32-bit floats.
      let worst = 0;
      let apart = 0;
      for (let i = 0; i < expected.length; i++) {
        const byte = bytes[Math.floor(i / 3) * 4 + (i % 3)]!;
        const difference = Math.abs(byte - expected[i]!);
        if (difference > 0.6) apart++;
        worst = Math.max(worst, difference);
      }
      // A pixel exactly at a picture's border may be in for one and out for the other.
      assert.ok(apart <= expected.length * 1e-3, `${apart} of ${expected.length}, worst ${worst}`);
    }
    await page.close();
  });
}

test("the value under the cursor is that of the map", async () => {
  const { page, fixture } = await pages.open("3D");
  const { scene, views } = fixture;
  await page.mouse.move(...(await onScreen(page, 70, 55)));
  await page.waitForFunction(() => document.querySelector("dd")?.textContent?.includes("70, 55"));
  assert.equal(await entry(page, "at"), "view_002  70, 55 px");
  assert.equal(await entry(page, "disparity"), "1.25 px per view step");
  assert.equal(await entry(page, "depth"), "1.091 m");
  const codes = codesOf(views[2]!.values, scene.value);
  for (const [u, v] of [
    [0, 0],
    [70, 55],
    [WIDTH - 1, 0],
    [3, HEIGHT - 1],
  ] as const) {
    const found = await page.evaluate(([x, y]) => gigaray.valueAt(x, y), [u, v] as const);
    assert.equal(found!.code, codes[v * WIDTH + u]);
    assert.equal(found!.value, valueOfCode(codes[v * WIDTH + u]!, scene.value));
    assert.equal(found!.confidence, (55 + Math.round((200 * u) / WIDTH)) / 255);
  }
  const none = await page.evaluate(([x, y]) => gigaray.valueAt(x, y), [
    WIDTH - 1,
    HEIGHT - 1,
  ] as const);
  assert.deepEqual([none!.value, none!.depth], [null, null]);
  await page.close();
});

test("of pictures made smaller the pixel is that of full size", async () => {
  const { page } = await pages.open("3D", ({ scene }) => {
    scene.scale = 0.5;
  });
  const found = await page.evaluate(() => gigaray.valueAt(70, 55));
  assert.deepEqual([found!.u, found!.v], [140.5, 110.5]);
  await page.close();
});

test("between views the picture is what a camera there would see", async () => {
  const { page } = await pages.open("3D");
  await page.evaluate(() => {
    const { viewpoint } = gigaray.state;
    return gigaray.set({ viewpoint: { ...viewpoint, s: 0.5, atView: false } });
  });
  const { bytes } = await pixels(page, "shown");
  const { rgb } = parallelView(0.5, 0);
  const differences: number[] = [];
  for (let v = 2; v < HEIGHT - 8; v++) {
    for (let u = 4; u < WIDTH - 8; u++) {
      const i = v * WIDTH + u;
      differences.push(Math.abs(bytes[4 * i]! - rgb[3 * i]!));
    }
  }
  const mean = differences.reduce((a, b) => a + b, 0) / differences.length;
  const bad = differences.filter((difference) => difference > 40).length / differences.length;
  // Points land on whole pixels: up to half a pixel of the texture's slope is expected.
  assert.ok(mean < 6, `mean ${mean}`);
  assert.ok(bad < 0.01, `${100 * bad} % are wrong`);
  await page.close();
});

test("arrow keys and drags move between views", async () => {
  const { page, fixture } = await pages.open("4D");
  await page.locator(".frame canvas").focus();
  const view = () =>
    page.evaluate(async () => {
      await new Promise((resolve) => setTimeout(resolve, 500));
      await gigaray.idle();
      return gigaray.state.viewpoint;
    });
  assert.equal((await view()).view, fixture.scene.top_view);
  await page.keyboard.press("ArrowRight");
  assert.deepEqual([(await view()).s, (await view()).t], [1, 0]);
  await page.keyboard.press("ArrowUp");
  assert.deepEqual([(await view()).s, (await view()).t], [1, -1]);
  await page.keyboard.press("Home");
  assert.deepEqual([(await view()).s, (await view()).t], [0, 0]);
  const [x, y] = await onScreen(page, 80, 60);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 150, y, { steps: 3 });
  assert.equal((await view()).atView, false);
  await page.mouse.move(x + 300, y, { steps: 3 });
  await page.mouse.up();
  const moved = await view();
  // The scene went right with the pointer: the camera is to the left.
  assert.deepEqual([moved.s, moved.t, moved.atView], [-1, 0, true]);
  await page.close();
});

test("a click in mask mode takes the depth of its pixel, and the line follows", async () => {
  const { page } = await pages.open("3D");
  await page.getByLabel("a click takes the depth of its pixel").check();
  const delta = page.getByLabel("half the interval of a click");
  await delta.fill("0.1");
  await delta.press("Enter");
  await page.mouse.click(...(await onScreen(page, 70, 55)));
  await page.waitForFunction(() => gigaray.state.intervalOn);
  const line = (await page.locator("code.line").textContent())!;
  const match = /^gigaray segment 'my result' --near (\S+) --far (\S+) -o masks$/.exec(line)!;
  assert.ok(Math.abs(Number(match[1]) - (CARD + 0.1)) < 1e-4, line);
  assert.ok(Math.abs(Number(match[2]) - (CARD - 0.1)) < 1e-4, line);
  const mask = await pixels(page, "mask");
  assert.equal(mask.bytes[55 * WIDTH + 70], 255);
  assert.equal(mask.bytes[5 * WIDTH + 5], 0);
  await page.close();
});

test("the wipe shows the other result on the right", async () => {
  const { page } = await pages.open("3D");
  await set(page, { overlay: "value", opacity: 1 });
  const own = await pixels(page, "shown");
  await set(page, { wipeOn: true, wipe: 0.5 });
  const wiped = await pixels(page, "shown");
  const at = (bytes: Uint8Array, u: number) => [
    ...bytes.slice(4 * (5 * WIDTH + u), 4 * (5 * WIDTH + u) + 3),
  ];
  assert.deepEqual(at(wiped.bytes, WIDTH / 2 - 1), at(own.bytes, WIDTH / 2 - 1));
  assert.notDeepEqual(at(wiped.bytes, WIDTH / 2), at(own.bytes, WIDTH / 2));
  await page.close();
});

test("a picked pixel has its EPI, its score curve and its samples", async () => {
  const { page } = await pages.open("3D");
  await page.mouse.click(...(await onScreen(page, 72, 56)));
  await page.waitForFunction(() =>
    [...document.querySelectorAll(".plot figcaption")].every((caption) => caption.textContent),
  );
  const captions = await page.locator(".plot figcaption").allTextContents();
  assert.match(captions[0]!, /EPI of row 56 · line: disparity 1.25/);
  assert.match(captions[1]!, /Scores at 72, 56 px · winner 1.25/);
  assert.match(captions[2]!, /What 5 of 5 views see there/);
  const drawn = await page.evaluate(() =>
    [...document.querySelectorAll<HTMLCanvasElement>(".plot canvas")].map((canvas) => {
      const context = canvas.getContext("2d")!;
      const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
      return data.some((byte) => byte > 0);
    }),
  );
  assert.deepEqual(drawn, [true, true, true]);
  await page.close();
});

test("3D shows points, a cloud and a surface", async () => {
  const { page, complaints } = await pages.open("3D");
  for (const points of ["view", "all", "cloud", "mesh"]) {
    await set(page, { stage: "3D", points, pointConfidence: 0 });
    await page.waitForTimeout(400);
    const shot = (await page.locator(".points canvas").screenshot()).toString("base64");
    const colors = await page.evaluate(async (base64) => {
      const bytes = Uint8Array.from(atob(base64), (char) => char.charCodeAt(0));
      const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
      const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
      const context = canvas.getContext("2d")!;
      context.drawImage(bitmap, 0, 0);
      const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
      const found = new Set<number>();
      for (let i = 0; i < data.length; i += 4) {
        found.add((data[i]! << 16) | (data[i + 1]! << 8) | data[i + 2]!);
      }
      return found.size;
    }, shot);
    assert.ok(colors > 50, `${points}: ${colors} colours`);
  }
  assert.deepEqual(complaints, []);
  await page.close();
});

for (const stage of ["picture", "3D"]) {
  test(`${stage}: Tab reaches every control, and focus is to be seen`, async () => {
    const { page } = await pages.open("3D");
    await set(page, { picked: { view: 2, u: 70, v: 55 }, stage, overlay: "value", wipeOn: true });
    await page.waitForTimeout(200);
    const expected = await page.evaluate(() => {
      const all = document.querySelectorAll<HTMLElement>(
        "input, select, button, canvas[tabindex], code",
      );
      // Of radio buttons of one name the chosen one stands for all: arrow keys go between them.
      const usable = [...all].filter(
        (control) =>
          control.checkVisibility() &&
          !control.matches(":disabled") &&
          !(control.matches("[type=radio]") && !control.matches(":checked")),
      );
      usable.forEach((control, idx) => {
        control.dataset.test = String(idx);
      });
      return usable.length;
    });
    const reached = new Set<string>();
    for (let i = 0; i < expected + 3; i++) {
      await page.keyboard.press("Tab");
      const focus = await page.evaluate(() => {
        const active = document.activeElement as HTMLElement;
        if (active === document.body) return null;
        const shown = active.matches(".choice input") ? active.nextElementSibling! : active;
        const named =
          active.ariaLabel || (active as HTMLInputElement).labels?.length || active.textContent;
        return {
          id: active.dataset.test,
          outline: getComputedStyle(shown).outlineStyle,
          named: Boolean(named),
        };
      });
      if (focus?.id === undefined) continue;
      assert.equal(focus.outline, "solid");
      assert.ok(focus.named);
      reached.add(focus.id);
    }
    assert.equal(reached.size, expected);
    await page.close();
  });
}

const DAMAGES: [string, (fixture: Fixture) => void, RegExp][] = [
  [
    "a newer version",
    ({ scene }) => {
      scene.version = 9;
    },
    /of version 9/,
  ],
  [
    "a missing picture",
    ({ blobs }) => {
      blobs.delete("view_002.png");
    },
    /view_002.png is missing/,
  ],
  [
    "a missing map of another view",
    ({ blobs }) => {
      blobs.delete("view_004.value");
    },
    /view_004.value is missing/,
  ],
  [
    "half a map",
    ({ blobs }) => {
      blobs.set("view_002.value", blobs.get("view_002.value")!.slice(0, 90));
    },
    /view_002.value is not a whole gzip/,
  ],
  [
    "a picture of another size",
    ({ scene }) => {
      scene.views[2]!.width = 99;
    },
    /view_002.(png|value) has/,
  ],
  [
    "no picture at all",
    ({ blobs }) => {
      blobs.set("view_002.png", new Uint8Array(50));
    },
    /view_002.png is not a picture/,
  ],
  [
    "no list of views",
    ({ scene }) => {
      scene.views = 7 as never;
    },
    /views is not a list/,
  ],
];

for (const [name, damage, line] of DAMAGES) {
  test(`damaged: ${name} gives one line in place of the panels`, async () => {
    const { page } = await pages.open("3D", damage);
    const alert = page.getByRole("alert");
    assert.match((await alert.textContent())!, line);
    assert.equal(await page.locator("aside").count(), 0);
    assert.doesNotMatch((await alert.textContent())!, /\n/);
    await page.close();
  });
}

test("damage that is found later also gives one line", async () => {
  const { page } = await pages.open("3D", ({ blobs }) => {
    blobs.set("view_003.png", new Uint8Array(50));
  });
  assert.equal(await page.getByRole("alert").count(), 0);
  await page.locator("select").selectOption("3");
  await page.getByRole("alert").waitFor();
  assert.match((await page.getByRole("alert").textContent())!, /view_003.png is not a picture/);
  await page.close();
});

test("without WebGL2 there is one line", async () => {
  const { page } = await pages.open("3D", undefined, (page) =>
    page.addInitScript(() => {
      HTMLCanvasElement.prototype.getContext = () => null as never;
    }),
  );
  assert.match((await page.getByRole("alert").textContent())!, /no WebGL2/);
  await page.close();
});

test("a lost context comes back with the same picture", async () => {
  const { page, fixture } = await pages.open("3D");
  const prevented = await page.evaluate(async () => {
    const canvas = document.querySelector<HTMLCanvasElement>(".frame canvas")!;
    const loss = canvas.getContext("webgl2")!.getExtension("WEBGL_lose_context")!;
    const lost = new Promise<boolean>((resolve) => {
      canvas.addEventListener("webglcontextlost", (event) => resolve(event.defaultPrevented));
    });
    loss.loseContext();
    const isPrevented = await lost;
    await new Promise((resolve) => setTimeout(resolve, 100));
    loss.restoreContext();
    await gigaray.idle();
    return isPrevented;
  });
  assert.ok(prevented);
  const { bytes } = await pixels(page, "shown");
  assert.deepEqual(
    bytes.filter((_, i) => i % 4 !== 3),
    fixture.views[2]!.rgb,
  );
  await set(page, { interval: { far: 1, near: 65535 } });
  assert.ok((await pixels(page, "mask")).bytes.includes(255));
  await page.close();
});

test("a folder opens from a web server and asks nobody else", async () => {
  const { page, requests, complaints, fixture } = await pages.serve("4D");
  assert.equal(await page.getByRole("alert").count(), 0);
  const { bytes } = await pixels(page, "shown");
  assert.deepEqual(
    bytes.filter((_, i) => i % 4 !== 3),
    fixture.views[4]!.rgb,
  );
  const { origin } = new URL(page.url());
  assert.deepEqual(
    requests.filter((url) => !/^(blob|data):/.test(url) && !url.startsWith(origin)),
    [],
  );
  // Nothing is read before it is shown.
  assert.ok(!requests.some((url) => url.endsWith("view_000.png")));
  assert.deepEqual(complaints, []);
  await page.close();
});

test("a folder without its scene gives one line", async () => {
  const { page } = await pages.serve("3D", ({ blobs }) => {
    blobs.delete("view_002.png");
  });
  assert.match((await page.getByRole("alert").textContent())!, /data\/view_002.png is missing/);
  await page.close();
});
