// SPDX-License-Identifier: BSD-3-Clause

import { MAX_CODE } from '../math/codes';
import type { Codes } from '../scene/scene_data';

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
