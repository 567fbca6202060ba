// SPDX-License-Identifier: BSD-3-Clause
// Why a depth: the score of every hypothesis, the winner, and what the views see at it.

import { formatNumber } from "../math/scene_depth";
import type { Range } from "../scene/format";
import { type ScoreCurve, scoreCurve } from "../scene/score_curve";
import { pixelValues } from "../state/pixel_values";
import type { Session } from "../state/session";
import { el } from "./dom";
import { plotCanvas } from "./plot_canvas";

export function scorePanel(session: Session): HTMLElement | null {
  const { scene, store, data } = session;
  if (scene.scores === null && !scene.live) return null;
  let curve: ScoreCurve | null = null;
  let winner: number | null = null;
  const caption = el("figcaption");
  const canvas = el("canvas", { role: "img" });
  const figure = el("figure", { class: "plot score" }, caption, canvas);
  const redraw = plotCanvas(canvas, (context, width, height) => {
    if (curve !== null) drawCurve(context, width, height, curve, winner);
  });
  let running = new AbortController();
  store.watch(["picked"], ({ picked }) => {
    running.abort();
    running = new AbortController();
    const { signal } = running;
    if (picked === null) return;
    void (async () => {
      const found = await scoreCurve(data, picked, signal);
      // The winner is that of the pixel whose curve it is, which may be beside the picked one.
      const at = found === null ? picked : { ...picked, u: found.u, v: found.v };
      const values = await pixelValues(session, at);
      if (signal.aborted) return;
      curve = found;
      winner = values?.value ?? null;
      caption.textContent = captionOf(session, found, winner);
      canvas.setAttribute("aria-label", caption.textContent);
      canvas.hidden = found === null;
      redraw();
    })().catch((reason) => {
      if (!signal.aborted) session.report(reason);
    });
  });
  return figure;
}

function captionOf(session: Session, curve: ScoreCurve | null, winner: number | null): string {
  const { scene } = session;
  if (curve === null) {
    return `Score curves belong to ${scene.views[scene.scores!.view]!.name} alone`;
  }
  const value = winner === null ? "no estimate" : `winner ${formatNumber(winner, 4)}`;
  return `Scores at ${curve.u}, ${curve.v} px · ${value}`;
}

function drawCurve(
  context: CanvasRenderingContext2D,
  width: number,
  height: number,
  curve: ScoreCurve,
  winner: number | null,
): void {
  const { hypotheses, scores } = curve;
  const [left, right, top, bottom] = [26, width - 8, 6, height - 18];
  const x = (value: number) =>
    left + ((value - hypotheses.min) / spanOf(hypotheses)) * (right - left);
  const y = (score: number) => bottom - score * (bottom - top);
  context.font = "11px system-ui, sans-serif";
  context.fillStyle = "#8f969c";
  context.strokeStyle = "#33373b";
  context.lineWidth = 1;
  for (const score of [0, 0.5, 1]) {
    context.strokeRect(left, y(score), right - left, 0);
    context.textAlign = "right";
    context.fillText(String(score), left - 4, y(score) + 4);
  }
  const { min, max } = hypotheses;
  for (const [value, align] of [
    [min, "left"],
    [(min + max) / 2, "center"],
    [max, "right"],
  ] as const) {
    context.textAlign = align;
    context.fillText(formatNumber(value, 3), x(value), height - 4);
  }
  if (winner !== null) {
    context.strokeStyle = "#f0a24b";
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(x(winner), top);
    context.lineTo(x(winner), bottom);
    context.stroke();
  }
  context.strokeStyle = "#d6d9db";
  context.lineWidth = 1.25;
  context.beginPath();
  let drawing = false;
  scores.forEach((score, idx) => {
    // Untested hypotheses interrupt the line.
    if (score !== null) {
      const at = x(min + (idx * (max - min)) / (scores.length - 1));
      if (drawing) context.lineTo(at, y(score));
      else context.moveTo(at, y(score));
    }
    drawing = score !== null;
  });
  context.stroke();
}

function spanOf(range: Range): number {
  return Math.max(range.max - range.min, 1e-12);
}
