// SPDX-License-Identifier: BSD-3-Clause
// What every view sees of the picked pixel at its depth: where the depth is right, the same colour.

import { apply } from "../math/camera";
import { transformFor, viewpointOfView } from "../math/viewpoint";
import { pixelValues } from "../state/pixel_values";
import type { Session } from "../state/session";
import type { PixelOfView } from "../state/view_state";
import { el } from "./dom";

/** More views than this are thinned out evenly. */
const MOST_VIEWS = 150;
const PATCH_PX = 5;

interface Sample {
  picture: ImageBitmap;
  u: number;
  v: number;
}

export function samplesPanel(session: Session): HTMLElement | null {
  const { scene, store } = session;
  const withPicture = [...scene.views.keys()].filter((view) => scene.views[view]!.image !== null);
  if (withPicture.length < 2) return null;
  const thin = Math.ceil(withPicture.length / MOST_VIEWS);
  const views = withPicture.filter((_, idx) => idx % thin === 0);
  const caption = el("figcaption");
  const canvas = el("canvas", { role: "img" });
  let wanted = 0;
  store.watch(["picked"], ({ picked }) => {
    const number = ++wanted;
    if (picked === null) return;
    samplesOf(session, views, picked)
      .then((samples) => {
        if (number !== wanted) return;
        const seen = samples?.filter((sample) => sample !== null).length ?? 0;
        caption.textContent =
          samples === null
            ? "Samples: no estimate"
            : `What ${seen} of ${views.length} views see there, ${PATCH_PX} px`;
        canvas.setAttribute("aria-label", caption.textContent);
        draw(canvas, samples ?? []);
      })
      .catch((reason) => session.report(reason));
  });
  return el("figure", { class: "plot samples" }, caption, el("div", {}, canvas));
}

/** Where each view sees the pixel's point; null outside its picture. */
async function samplesOf(
  session: Session,
  views: number[],
  pixel: PixelOfView,
): Promise<(Sample | null)[] | null> {
  const { scene, data } = session;
  const value = (await pixelValues(session, pixel))?.value ?? null;
  if (value === null) return null;
  const from = viewpointOfView(scene, pixel.view);
  return Promise.all(
    views.map(async (view) => {
      const { matrix, vector } = transformFor(scene, from, viewpointOfView(scene, view));
      const seen = apply(matrix, [pixel.u, pixel.v, 1]).map((x, i) => x + value * vector[i]!);
      const [u, v] = [seen[0]! / seen[2]!, seen[1]! / seen[2]!];
      const { width, height } = scene.views[view]!;
      if (seen[2]! <= 0 || u < 0 || v < 0 || u > width - 1 || v > height - 1) return null;
      return { picture: await data.picture(view), u, v };
    }),
  );
}

/** A small patch of each view, side by side in rows. */
function draw(canvas: HTMLCanvasElement, samples: (Sample | null)[]): void {
  const columns = Math.ceil(Math.sqrt(samples.length * 2));
  const cell = PATCH_PX + 1;
  canvas.width = Math.max(1, columns * cell - 1);
  canvas.height = Math.max(1, Math.ceil(samples.length / columns) * cell - 1);
  const context = canvas.getContext("2d")!;
  samples.forEach((sample, idx) => {
    const [x, y] = [(idx % columns) * cell, Math.floor(idx / columns) * cell];
    if (sample === null) {
      context.strokeStyle = "#33373b";
      context.strokeRect(x + 0.5, y + 0.5, PATCH_PX - 1, PATCH_PX - 1);
      return;
    }
    // The patch's middle is the pixel centre, which lies half a pixel inside the canvas's pixel.
    const [u, v] = [sample.u + 0.5 - PATCH_PX / 2, sample.v + 0.5 - PATCH_PX / 2];
    context.drawImage(sample.picture, u, v, PATCH_PX, PATCH_PX, x, y, PATCH_PX, PATCH_PX);
  });
}
