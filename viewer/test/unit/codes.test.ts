// SPDX-License-Identifier: BSD-3-Clause

import assert from "node:assert/strict";
import { test } from "node:test";
import { codeOfValue, decodeCodes8, decodeCodes16, valueOfCode } from "../../src/math/codes";
import { gunzip } from "../../src/scene/gunzip";
import { codesOf, differences8, differences16, gzip } from "../fixture/encode";

const WIDTH = 7;
const HEIGHT = 5;

test("16-bit codes come back from their differences", () => {
  const codes = Uint16Array.from({ length: WIDTH * HEIGHT }, (_, i) => (i * 40503) & 0xffff);
  codes.set([0, 65535, 0, 1, 65535]);
  assert.deepEqual(decodeCodes16(differences16(codes, WIDTH), WIDTH, HEIGHT), codes);
});

test("8-bit codes come back from their differences", () => {
  const codes = Uint8Array.from({ length: WIDTH * HEIGHT }, (_, i) => (i * 151) & 0xff);
  assert.deepEqual(decodeCodes8(differences8(codes, WIDTH), WIDTH, HEIGHT), codes);
});

test("differences are as written down: rows on their own, high bytes first", () => {
  // Codes 258, 257 and 3, 4: differences 258, −1 and 3, 1.
  const bytes = Uint8Array.of(1, 255, 0, 0, 2, 255, 3, 1);
  assert.deepEqual(decodeCodes16(bytes, 2, 2), Uint16Array.of(258, 257, 3, 4));
});

test("code 1 is min, 65535 is max, 0 is none", () => {
  const range = { min: -1.2, max: 3.4 };
  assert.equal(valueOfCode(1, range), -1.2);
  assert.ok(Math.abs(valueOfCode(65535, range) - 3.4) < 1e-12);
  assert.ok(Number.isNaN(valueOfCode(0, range)));
  assert.equal(codeOfValue(-1.2, range), 1);
  assert.deepEqual(
    codesOf(Float64Array.of(Number.NaN, -1.2, 3.4), range),
    Uint16Array.of(0, 1, 65535),
  );
});

test("gunzip takes exactly the bytes that the size says", async () => {
  const bytes = new Uint8Array(1000).map((_, i) => i);
  const packed = new Uint8Array(gzip(bytes));
  assert.deepEqual(await gunzip(packed, 1000, "x"), bytes);
  await assert.rejects(gunzip(packed, 1001, "x"), /x has 1000 bytes instead of 1001/);
  await assert.rejects(gunzip(packed, 999, "x"), /x has 1000 bytes instead of 999/);
  await assert.rejects(gunzip(packed.slice(0, 40), 1000, "x"), /x is not a whole gzip stream/);
  await assert.rejects(gunzip(bytes, 1000, "x"), /x is not a whole gzip stream/);
});
