// SPDX-License-Identifier: BSD-3-Clause

import { isParallel, type Scene } from "../scene/format";

/** Depth in scene units of a value; null where the scene doesn't know it, or at and behind infinity. */
export function depthOfValue(value: number, scene: Scene): number | null {
  if (scene.depth === null || !Number.isFinite(value)) return null;
  if (!isParallel(scene)) return value > 0 ? 1 / value : null;
  const { focal_times_baseline: product, disparity_at_infinity: infinity } = scene.depth;
  if (product === undefined || infinity === undefined || value <= infinity) return null;
  return product / (value - infinity);
}

/** Pixel of the full-size picture at a pixel of what is shown; pixel centres are integers. */
export function fullSizePixel(shown: number, scale: number): number {
  return (shown + 0.5) / scale - 0.5;
}

/** Pixel of what is shown at a pixel of the full-size picture. */
export function shownPixel(full: number, scale: number): number {
  return (full + 0.5) * scale - 0.5;
}

/** Up to `digits` significant digits without trailing zeros or exponent. */
export function formatNumber(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const decimals = Math.min(12, Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(value)))));
  const text = value.toFixed(decimals).replace("-", "−");
  return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}

/** A depth with its unit. */
export function formatDepth(depth: number | null, scene: Scene): string {
  if (depth === null || scene.depth === null) return "–";
  const unit = scene.depth.unit === "" ? "scene units" : scene.depth.unit;
  return `${formatNumber(depth, 4)} ${unit}`;
}
