// SPDX-License-Identifier: BSD-3-Clause

import assert from "node:assert/strict";
import { test } from "node:test";
import { valueOfCode } from "../../src/math/codes";
import {
  farThreshold,
  inInterval,
  intervalAround,
  nearThreshold,
  plainDecimal,
  segmentLine,
} from "../../src/math/interval";

const RANGE = { min: -1.2, max: 3.4 };

test("thresholds decide like codes, for every code", () => {
  for (const interval of [
    { near: 65535, far: 1 },
    { near: 30000, far: 29990 },
    { near: 5, far: 5 },
    { near: 1, far: 1 },
    { near: 65535, far: 65535 },
  ]) {
    // The program reads the printed number and compares values as 32-bit floats.
    const near = Number(plainDecimal(nearThreshold(interval, RANGE)));
    const far = Number(plainDecimal(farThreshold(interval, RANGE)));
    for (let code = 0; code <= 65535; code++) {
      const value = Math.fround(valueOfCode(code, RANGE));
      assert.equal(inInterval(code, interval), value >= far && value <= near, `code ${code}`);
    }
  }
});

test("a click takes what lies within delta", () => {
  const range = { min: 0, max: 65534 };
  assert.deepEqual(intervalAround(101, 10, range), { near: 111, far: 91 });
  assert.deepEqual(intervalAround(101, 0, range), { near: 101, far: 101 });
  assert.deepEqual(intervalAround(101, 0.4, range), { near: 101, far: 101 });
  assert.deepEqual(intervalAround(3, 10, range), { near: 13, far: 1 });
  assert.deepEqual(intervalAround(65530, 10, range), { near: 65535, far: 65520 });
});

test("the line has plain decimals", () => {
  assert.equal(plainDecimal(-1.5e-7), "-0.00000015");
  assert.equal(plainDecimal(1.25e21), "1250000000000000000000");
  assert.equal(plainDecimal(-0.25), "-0.25");
  const range = { min: 0, max: 65534 };
  assert.equal(
    segmentLine("'my result'", { near: 11, far: 3 }, range),
    "gigaray segment 'my result' --near 10.5 --far 1.5 -o masks",
  );
});
