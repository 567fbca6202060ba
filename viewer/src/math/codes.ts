// SPDX-License-Identifier: BSD-3-Clause
// The 16-bit code of value and error maps: 0 is no estimate, 1 … 65535 is min … max in equal steps.

import type { Range } from "../scene/format";

/** Codes are 1 … MAX_CODE. */
export const MAX_CODE = 65535;
const STEPS = 65534;

/** The value of a code ≥ 1, which may be a half code; NaN for 0. */
export function valueOfCode(code: number, range: Range): number {
  if (code <= 0) return Number.NaN;
  return range.min + ((code - 1) * (range.max - range.min)) / STEPS;
}

/** The real-valued code of a value; below 1 and above MAX_CODE outside the range. */
export function codeOfValue(value: number, range: Range): number {
  return 1 + ((value - range.min) * STEPS) / (range.max - range.min);
}

/** The nearest code of a value, in 1 … MAX_CODE. */
export function nearestCode(value: number, range: Range): number {
  return clampCode(Math.round(codeOfValue(value, range)));
}

export function clampCode(code: number): number {
  return Math.min(MAX_CODE, Math.max(1, code));
}

/**
 * Undoes the left differences of 16-bit codes: all high bytes, then all low bytes, every row on its
 * own and its first column against 0.
 */
export function decodeCodes16(
  bytes: Uint8Array,
  width: number,
  height: number,
): Uint16Array<ArrayBuffer> {
  const count = width * height;
  const codes = new Uint16Array(count);
  for (let v = 0; v < height; v++) {
    let code = 0;
    for (let i = v * width; i < (v + 1) * width; i++) {
      code = (code + ((bytes[i]! << 8) | bytes[count + i]!)) & 0xffff;
      codes[i] = code;
    }
  }
  return codes;
}

/** Undoes the left differences of 8-bit codes, every row on its own and its first column against 0. */
export function decodeCodes8(
  bytes: Uint8Array,
  width: number,
  height: number,
): Uint8Array<ArrayBuffer> {
  const codes = new Uint8Array(width * height);
  for (let v = 0; v < height; v++) {
    let code = 0;
    for (let i = v * width; i < (v + 1) * width; i++) {
      code = (code + bytes[i]!) & 0xff;
      codes[i] = code;
    }
  }
  return codes;
}
