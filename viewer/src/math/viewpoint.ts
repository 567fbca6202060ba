// SPDX-License-Identifier: BSD-3-Clause
// Where the light field is seen from: at a view, or somewhere between.

import { type CameraEntry, isParallel, type Scene } from "../scene/format";
import { distance, position, type Transform, transformBetween } from "./camera";

export interface Viewpoint {
  /** View steps. */
  s: number;
  t: number;
  /** For the size of the view that it is nearest to. */
  camera: CameraEntry;
  /** Index of the view whose place it is, or the nearest one. */
  view: number;
  /** True at the place of that view. */
  atView: boolean;
}

export function viewpointOfView(scene: Scene, view: number): Viewpoint {
  const { s, t, camera } = scene.views[view]!;
  return { s, t, camera, view, atView: true };
}

/** Index of the view nearest to a place, in view steps. */
export function nearestView(scene: Scene, s: number, t: number): number {
  let best = 0;
  let bestSquare = Number.POSITIVE_INFINITY;
  scene.views.forEach((view, idx) => {
    const square = (view.s - s) ** 2 + (view.t - t) ** 2;
    if (square < bestSquare) {
      best = idx;
      bestSquare = square;
    }
  });
  return best;
}

/** The place (s, t) of a parallel light field. */
export function viewpointAt(scene: Scene, s: number, t: number): Viewpoint {
  const view = nearestView(scene, s, t);
  const entry = scene.views[view]!;
  const atView = Math.hypot(entry.s - s, entry.t - t) < 1e-6;
  return { s, t, camera: entry.camera, view, atView };
}

/**
 * Where a pixel of `from` with a value (of its value map) is seen from `to`, in px shown. For
 * parallel views u' = u + (ŝ − s) d, v' = v + (t̂ − t) d, with d in full-size px.
 */
export function transformFor(scene: Scene, from: Viewpoint, to: Viewpoint): Transform {
  if (!isParallel(scene)) return transformBetween(from.camera, to.camera);
  return {
    matrix: [1, 0, 0, 0, 1, 0, 0, 0, 1],
    vector: [(from.s - to.s) * scene.scale, (from.t - to.t) * scene.scale, 0],
  };
}

/** Distance of two viewpoints: view steps, or scene units where cameras stand anywhere. */
export function distanceBetween(scene: Scene, a: Viewpoint, b: Viewpoint): number {
  if (isParallel(scene)) return Math.hypot(a.s - b.s, a.t - b.t);
  return distance(position(a.camera), position(b.camera));
}

/**
 * Up to `count` of the nearest views that have a map of values, with weights that sum to 1. A weight
 * reaches zero where the view leaves the set, so that nothing jumps while the viewpoint moves.
 */
export function nearestMaps(
  scene: Scene,
  viewpoint: Viewpoint,
  count: number,
): { view: number; weight: number }[] {
  const found = scene.views
    .map((entry, view) => ({ entry, view }))
    .filter(({ entry }) => entry.maps !== null && entry.image !== null)
    .map(({ view }) => ({
      view,
      distance: distanceBetween(scene, viewpointOfView(scene, view), viewpoint),
    }))
    .sort((a, b) => a.distance - b.distance)
    .slice(0, count + 1);
  if (found.length === 0) return [];
  if (found[0]!.distance === 0) return [{ view: found[0]!.view, weight: 1 }];
  const limit = found.length > count ? found[count]!.distance : Number.POSITIVE_INFINITY;
  const weighted = found.slice(0, count).map(({ view, distance: away }) => ({
    view,
    weight: Math.max(1e-3, 1 - away / limit) / away,
  }));
  const sum = weighted.reduce((total, { weight }) => total + weight, 0);
  return weighted.map(({ view, weight }) => ({ view, weight: weight / sum }));
}

/** The next view from `view` towards (right, down), each −1 … 1; itself where there is none. */
export function neighbour(scene: Scene, view: number, right: number, down: number): number {
  const here = scene.views[view]!;
  const offsets = scene.views.map((entry) => offsetOf(scene, here, entry));
  let best = view;
  let bestCost = Number.POSITIVE_INFINITY;
  offsets.forEach(([x, y], idx) => {
    const along = x * right + y * down;
    const aside = Math.abs(x * down - y * right);
    if (idx === view || along <= 1e-9 || aside > along) return;
    const cost = along + 2 * aside;
    if (cost < bestCost) {
      best = idx;
      bestCost = cost;
    }
  });
  return best;
}

/** Of a view as seen from another: to the right and down. */
function offsetOf(
  scene: Scene,
  from: Scene["views"][number],
  to: Scene["views"][number],
): number[] {
  if (isParallel(scene)) return [to.s - from.s, to.t - from.t];
  const place = position(to.camera);
  const { rotation: r, translation: t } = from.camera;
  return [0, 1].map(
    (i) =>
      r[3 * i]! * place[0] + r[3 * i + 1]! * place[1] + r[3 * i + 2]! * place[2] + t[i as 0 | 1],
  );
}
