// SPDX-License-Identifier: BSD-3-Clause

import { fullSizePixel } from "../math/scene_depth";
import type { PixelOfView } from "../state/view_state";
import { Field } from "./field";
import type { Range, ScoreCurves } from "./format";
import type { SceneData } from "./scene_data";

/** How well the views agree on each hypothesis of a pixel. */
export interface ScoreCurve {
  hypotheses: Range;
  /** 0 … 1; null where the hypothesis was not tested. */
  scores: (number | null)[];
  /** The pixel that it belongs to, px shown; of a grid the nearest one to that asked for. */
  u: number;
  v: number;
  /** What the views see there, 0 … 1 of sRGB; only from a server. */
  samples: { view: string; rgb: number[] | null }[] | null;
}

/** The curve of a pixel; null where the scene has none for its view. */
export async function scoreCurve(
  data: SceneData,
  pixel: PixelOfView,
  signal: AbortSignal,
): Promise<ScoreCurve | null> {
  const { scene } = data;
  if (scene.live) {
    const u = fullSizePixel(pixel.u, scene.scale);
    const v = fullSizePixel(pixel.v, scene.scale);
    const name = encodeURIComponent(scene.views[pixel.view]!.name);
    const answer = await fetch(`probe?view=${name}&u=${u}&v=${v}`, { signal });
    return parseProbe(await answer.json(), pixel);
  }
  if (scene.scores === null || scene.scores.view !== pixel.view) return null;
  return storedCurve(await data.scores(), scene.scores, pixel);
}

/** The curve of the grid's pixel that is nearest. */
export function storedCurve(bytes: Uint8Array, grid: ScoreCurves, pixel: PixelOfView): ScoreCurve {
  const { step, columns, rows, hypotheses } = grid;
  const middle = Math.floor(step / 2);
  const nearest = (x: number, count: number) =>
    Math.min(count - 1, Math.max(0, Math.round((x - middle) / step)));
  const column = nearest(pixel.u, columns);
  const row = nearest(pixel.v, rows);
  const start = (row * columns + column) * hypotheses.count;
  const scores = Array.from(bytes.subarray(start, start + hypotheses.count), (byte) =>
    byte === 255 ? null : byte / 254,
  );
  return { hypotheses, scores, u: column * step + middle, v: row * step + middle, samples: null };
}

/** What the server's probe answers; throws its line where it has no curve. */
export function parseProbe(json: unknown, pixel: PixelOfView): ScoreCurve {
  const answer = new Field(json, "probe");
  const failure = answer.at("error").optional((field) => field.string());
  if (failure !== null) throw new Error(failure);
  const hypotheses = answer.at("hypotheses");
  return {
    hypotheses: { min: hypotheses.at("min").number(), max: hypotheses.at("max").number() },
    scores: answer
      .at("scores")
      .list()
      .map((field) => field.optional((score) => score.number())),
    u: pixel.u,
    v: pixel.v,
    samples: answer.at("samples").optional((field) =>
      field.list().map((sample) => ({
        view: sample.at("view").string(),
        rgb: sample.at("rgb").optional((rgb) => rgb.numbers(3)),
      })),
    ),
  };
}
