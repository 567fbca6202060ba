// SPDX-License-Identifier: BSD-3-Clause

import { clampCode, MAX_CODE } from "../math/codes";
import type { Interval } from "../math/interval";
import type { Codes } from "../scene/scene_data";

/**
 * The codes that all but the outermost 0.5 % of the estimates lie between. Colours and sliders use
 * them: a few outliers must not take the whole range.
 */
export function usualCodes(codes: Codes): [number, number] {
  const counts = new Uint32Array(MAX_CODE + 1);
  let total = 0;
  for (const code of codes) {
    if (code === 0) continue;
    counts[code]!++;
    total++;
  }
  if (total === 0) return [1, MAX_CODE];
  const skipped = total * 0.005;
  let low = 1;
  for (let seen = counts[low]!; seen <= skipped; seen += counts[++low]!);
  let high = MAX_CODE;
  for (let seen = counts[high]!; seen <= skipped; seen += counts[--high]!);
  return low < high ? [low, high] : [Math.max(1, low - 1), Math.min(MAX_CODE, low + 1)];
}

/** The interval that sliders span: the usual codes with some room, so that they are fine. */
export function sliderCodes(usual: [number, number]): Interval {
  const room = Math.round((usual[1] - usual[0]) * 0.05) + 1;
  return { far: clampCode(usual[0] - room), near: clampCode(usual[1] + room) };
}
