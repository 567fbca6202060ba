// SPDX-License-Identifier: BSD-3-Clause

import { valueOfCode } from "../math/codes";
import { depthOfValue, fullSizePixel } from "../math/scene_depth";
import type { MapKind } from "../scene/format";
import type { Session } from "./session";
import type { PixelOfView } from "./view_state";

/** What the maps hold at a pixel. */
export interface PixelValues {
  view: string;
  /** Full-size px; pixel centres are integers. */
  u: number;
  v: number;
  /** 16-bit code; 0 is no estimate. */
  code: number;
  /** In the scene's unit of values; null where there is no estimate. */
  value: number | null;
  /** Scene units; null where unknown. */
  depth: number | null;
  /** 0 … 1 */
  confidence: number | null;
  level: number | null;
  /** Estimate minus truth, in the unit of values. */
  error: number | null;
}

/** Null where the view has no maps or the pixel lies outside. */
export async function pixelValues(
  session: Session,
  pixel: PixelOfView,
): Promise<PixelValues | null> {
  const { data, scene } = session;
  const { width, height, name } = scene.views[pixel.view]!;
  const { u, v } = pixel;
  if (u < 0 || v < 0 || u >= width || v >= height) return null;
  const read = async (kind: MapKind) =>
    data.hasMap(pixel.view, kind) ? (await data.map(pixel.view, kind))[v * width + u]! : null;
  const code = await read("value");
  if (code === null) return null;
  const value = code === 0 ? null : valueOfCode(code, scene.value);
  const [confidence, level, error] = [
    await read("confidence"),
    await read("level"),
    await read("error"),
  ];
  return {
    view: name,
    u: fullSizePixel(u, scene.scale),
    v: fullSizePixel(v, scene.scale),
    code,
    value,
    depth: value === null ? null : depthOfValue(value, scene),
    confidence: confidence === null ? null : confidence / 255,
    level: level === null || level === 255 ? null : level,
    error: error === null || error === 0 ? null : valueOfCode(error, scene.error!),
  };
}
