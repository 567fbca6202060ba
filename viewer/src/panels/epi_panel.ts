// SPDX-License-Identifier: BSD-3-Clause
// The epipolar-plane image of the picked row: the rows of all views of one t, stacked by s.

import { valueOfCode } from "../math/codes";
import { formatNumber } from "../math/scene_depth";
import { isParallel } from "../scene/format";
import { pixelValues } from "../state/pixel_values";
import type { Session } from "../state/session";
import type { PixelOfView } from "../state/view_state";
import { el } from "./dom";
import { plotCanvas } from "./plot_canvas";

interface Epi {
  pixel: PixelOfView;
  /** Views from the first to the last s. */
  rows: { s: number; view: number; picture: ImageBitmap }[];
  /** Full-size px per view step; null without an estimate. */
  disparity: number | null;
}

/** Views of one row of a grid differ less in t, view steps. */
const SAME_ROW = 0.25;

export function epiPanel(session: Session): HTMLElement | null {
  const { scene, store } = session;
  const wide = scene.views.some((view) => view.s !== scene.views[0]!.s);
  if (!isParallel(scene) || !wide) return null;
  let epi: Epi | null = null;
  const canvas = el("canvas", { role: "img" });
  const caption = el("figcaption");
  const redraw = plotCanvas(canvas, (context, width, height) => {
    if (epi !== null) drawEpi(context, width, height, epi, session);
  });
  let wanted = 0;
  store.watch(["picked"], ({ picked }) => {
    const number = ++wanted;
    if (picked === null) return;
    loadEpi(session, picked)
      .then((loaded) => {
        if (number !== wanted) return;
        epi = loaded;
        const line = loaded.disparity === null ? "no estimate" : formatNumber(loaded.disparity, 4);
        caption.textContent = `EPI of row ${picked.v} · line: ${scene.value.name} ${line}`;
        canvas.setAttribute("aria-label", caption.textContent);
        redraw();
      })
      .catch((reason) => session.report(reason));
  });
  return el("figure", { class: "plot epi" }, caption, canvas);
}

async function loadEpi(session: Session, pixel: PixelOfView): Promise<Epi> {
  const { scene, data } = session;
  const here = scene.views[pixel.view]!;
  const views = scene.views
    .map((entry, view) => ({ entry, view }))
    .filter(({ entry }) => entry.image !== null && Math.abs(entry.t - here.t) < SAME_ROW)
    .sort((a, b) => a.entry.s - b.entry.s);
  const rows = await Promise.all(
    views.map(async ({ entry, view }) => ({
      s: entry.s,
      view,
      picture: await data.picture(view),
    })),
  );
  const values = await pixelValues(session, pixel);
  return { pixel, rows, disparity: values?.value ?? null };
}

function drawEpi(
  context: CanvasRenderingContext2D,
  width: number,
  height: number,
  epi: Epi,
  session: Session,
): void {
  const { scene, usual } = session;
  const { pixel, rows, disparity } = epi;
  const here = scene.views[pixel.view]!;
  // Few views are stretched but not to bands that look like a flag.
  const rowHeight = Math.min(height / rows.length, 24);
  const top = (height - rowHeight * rows.length) / 2;
  // Only what the pixel's line can reach, with room, so that its slope is to be seen.
  const reach = Math.max(...usual.map((code) => Math.abs(valueOfCode(code, scene.value))));
  const steps = Math.max(...rows.map(({ s }) => Math.abs(s - here.s)));
  const half = Math.max(40, 2 * reach * steps * scene.scale);
  const left = Math.max(0, Math.min(pixel.u - half, here.width - 2 * half));
  const span = Math.min(here.width - left, 2 * half);
  const x = (u: number) => ((u + 0.5 - left) / span) * width;
  const y = (row: number) => top + (row + 0.5) * rowHeight;
  context.imageSmoothingEnabled = false;
  rows.forEach(({ picture }, row) => {
    context.drawImage(picture, left, pixel.v, span, 1, 0, y(row - 0.5), width, rowHeight);
  });
  if (disparity !== null) {
    const path = new Path2D();
    rows.forEach(({ s }, row) => {
      path.lineTo(x(pixel.u + (here.s - s) * disparity * scene.scale), y(row));
    });
    for (const [color, line] of [
      ["#000", 3.5],
      ["#f0a24b", 1.5],
    ] as const) {
      context.strokeStyle = color;
      context.lineWidth = line;
      context.stroke(path);
    }
  }
  const row = rows.findIndex(({ view }) => view === pixel.view);
  context.strokeStyle = "#fff";
  context.lineWidth = 1.5;
  context.beginPath();
  context.arc(x(pixel.u), y(row), 4, 0, 7);
  context.stroke();
}
