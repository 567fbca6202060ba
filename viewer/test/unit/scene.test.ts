// SPDX-License-Identifier: BSD-3-Clause

import assert from "node:assert/strict";
import { test } from "node:test";
import { depthOfValue, formatNumber } from "../../src/math/scene_depth";
import { parseScene } from "../../src/scene/parse_scene";
import { parseProbe, storedCurve } from "../../src/scene/score_curve";
import { FIXTURE_NAMES, makeFixture } from "../fixture/scenes";

// biome-ignore lint/suspicious/noExplicitAny: the tests break what the types promise
type Loose = any;

function parsed(change: (scene: Loose) => void): void {
  const scene = structuredClone(makeFixture("3D").scene);
  change(scene);
  parseScene(JSON.stringify(scene));
}

test("whole scenes are read as they are", () => {
  for (const name of FIXTURE_NAMES) {
    const text = JSON.stringify(makeFixture(name).scene);
    assert.deepEqual(parseScene(text), JSON.parse(text));
  }
});

test("what the format leaves out may be missing", () => {
  parsed((scene) => {
    for (const key of ["depth", "error", "confidence", "segment", "scores", "compare", "cloud"]) {
      delete scene[key];
    }
    for (const view of scene.views) view.maps = null;
    scene.something_newer = { of: "the same version" };
  });
});

test("whatever is wrong is named in one line", () => {
  const cases: [(scene: Loose) => void, RegExp][] = [
    [(scene) => delete scene.format, /not the description of a gigaray scene/],
    [(scene) => (scene.version = 2), /is of version 2; this page reads up to version 1/],
    [(scene) => (scene.kind = "5D"), /kind is not 3D, 4D or unstructured/],
    [(scene) => delete scene.title, /title is missing/],
    [(scene) => (scene.value.max = scene.value.min), /value.max is not above its min/],
    [(scene) => (scene.value.min = null), /value.min is not a number/],
    [(scene) => (scene.scale = 0), /scale is not above zero/],
    [(scene) => (scene.top_view = 5), /top_view is not an integer from 0 to 4/],
    [(scene) => (scene.views = []), /views is not a list of views/],
    [(scene) => (scene.views[1].width = 1e9), /views\[1\].width is not an integer from 1 to 16384/],
    [(scene) => (scene.views[3].name = "view_000"), /two views are named view_000/],
    [(scene) => delete scene.views[0].camera, /views\[0\].camera is missing/],
    [(scene) => scene.views[0].camera.rotation.pop(), /camera.rotation is not a list of 9/],
    [(scene) => delete scene.views[2].maps.value, /views\[2\].maps.value is missing/],
    [(scene) => delete scene.error, /error is missing/],
    [(scene) => (scene.depth.focal_times_baseline = 0), /focal_times_baseline is not above zero/],
    [(scene) => delete scene.scores.blob, /scores.blob is missing/],
    [(scene) => (scene.scores.hypotheses.count = 1), /count is not an integer from 2/],
    [
      (scene) => (scene.compare.maps.view_000 = { value: 7 }),
      /compare.maps.view_000.value is not text/,
    ],
    [(scene) => (scene.inverse_depth = 1), /inverse_depth is not an object/],
  ];
  for (const [change, line] of cases) {
    assert.throws(
      () => parsed(change),
      (error: Error) => line.test(error.message) && !error.message.includes("\n"),
      String(line),
    );
  }
  assert.throws(() => parseScene('{"format"'), /not JSON/);
  assert.throws(() => parseScene("null"), /not the description/);
});

test("depth in scene units", () => {
  const { scene } = makeFixture("3D");
  assert.equal(depthOfValue(0, scene), 2);
  assert.equal(depthOfValue(-1.5, scene), null);
  assert.equal(depthOfValue(0.5, makeFixture("unstructured").scene), 2);
  assert.equal(depthOfValue(0, makeFixture("unstructured").scene), null);
});

test("numbers are short, without an exponent", () => {
  assert.equal(formatNumber(0.000012345, 3), "0.0000123");
  assert.equal(formatNumber(123456, 3), "123456");
  assert.equal(formatNumber(-1.5, 4), "−1.5");
  assert.equal(formatNumber(Number.NaN), "–");
});

test("a pixel gets the score curve of the nearest place of the grid", () => {
  const grid = {
    view: 0,
    step: 16,
    columns: 3,
    rows: 2,
    hypotheses: { min: 0, max: 1, count: 2 },
    blob: "scores",
  };
  const bytes = Uint8Array.of(0, 0, 0, 0, 0, 0, 0, 0, 127, 255, 254, 0);
  const curve = storedCurve(bytes, grid, { view: 0, u: 20, v: 500 });
  assert.deepEqual([curve.u, curve.v], [24, 24]);
  assert.deepEqual(curve.scores, [0.5, null]);
});

test("a probe's answer is checked", () => {
  const pixel = { view: 0, u: 1, v: 2 };
  assert.throws(() => parseProbe({ error: "no such view" }, pixel), /no such view/);
  assert.throws(
    () => parseProbe({ hypotheses: { min: 0, max: 1 } }, pixel),
    /probe.scores is missing/,
  );
  const curve = parseProbe(
    {
      hypotheses: { min: 0, max: 1, count: 2 },
      scores: [null, 0.5],
      samples: [{ view: "a", rgb: null }],
    },
    pixel,
  );
  assert.deepEqual(curve.scores, [null, 0.5]);
  assert.deepEqual(curve.samples, [{ view: "a", rgb: null }]);
});
