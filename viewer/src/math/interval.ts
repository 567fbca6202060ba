// SPDX-License-Identifier: BSD-3-Clause
// A depth interval in codes. Thresholds lie on half codes, so that no rounding of a map's values
// decides about a pixel: the mask of the page is that of `gigaray segment` to the bit.

import type { Range } from "../scene/format";
import { clampCode, codeOfValue, MAX_CODE, valueOfCode } from "./codes";

/** The codes far ≤ code ≤ near belong to it; both are integers in 1 … MAX_CODE. */
export interface Interval {
  near: number;
  far: number;
}

/** The interval of what lies within `delta` (in the unit of values, ≥ 0) of the value of `code`. */
export function intervalAround(code: number, delta: number, range: Range): Interval {
  const value = valueOfCode(code, range);
  return {
    near: clampCode(Math.max(code, Math.floor(codeOfValue(value + delta, range)))),
    far: clampCode(Math.min(code, Math.ceil(codeOfValue(value - delta, range)))),
  };
}

/** True where the code has an estimate that belongs to the interval. */
export function inInterval(code: number, interval: Interval): boolean {
  return code >= 1 && code >= interval.far && code <= interval.near;
}

/** The value half a code above `near`: `--near` of `gigaray segment`. */
export function nearThreshold(interval: Interval, range: Range): number {
  return valueOfCode(interval.near + 0.5, range);
}

/** The value half a code below `far`: `--far` of `gigaray segment`. */
export function farThreshold(interval: Interval, range: Range): number {
  return range.min + ((interval.far - 1.5) * (range.max - range.min)) / (MAX_CODE - 1);
}

/** The line that makes the interval's masks on the command line. `result` is a shell word. */
export function segmentLine(result: string, interval: Interval, range: Range): string {
  const near = plainDecimal(nearThreshold(interval, range));
  const far = plainDecimal(farThreshold(interval, range));
  return `gigaray segment ${result} --near ${near} --far ${far} -o masks`;
}

/** The shortest digits that read back as the number, without an exponent. */
export function plainDecimal(value: number): string {
  const text = String(value);
  const match = /^(-?)(\d+)(?:\.(\d+))?e([+-]\d+)$/.exec(text);
  if (match === null) return text;
  const [, sign, whole, fraction = "", exponent] = match;
  const digits = whole! + fraction;
  const point = whole!.length + Number(exponent);
  if (point <= 0) return `${sign}0.${"0".repeat(-point)}${digits}`;
  if (point >= digits.length) return `${sign}${digits}${"0".repeat(point - digits.length)}`;
  return `${sign}${digits.slice(0, point)}.${digits.slice(point)}`;
}
