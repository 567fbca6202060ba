// SPDX-License-Identifier: BSD-3-Clause
// Moves of the viewpoint: to a view, by a drag, and the short way between two places.

import { cameraBetween, distance, movedCamera, position } from "../math/camera";
import { valueOfCode } from "../math/codes";
import {
  nearestView,
  neighbour,
  type Viewpoint,
  viewpointAt,
  viewpointOfView,
} from "../math/viewpoint";
import { isParallel } from "../scene/format";
import type { Session } from "./session";

const MOVE_MS = 180;

export class Moves {
  private animation = 0;

  constructor(private readonly session: Session) {}

  /** Goes to a view; the way is shown unless the reader wants little motion. */
  toView(view: number): void {
    const { scene, store } = this.session;
    const target = viewpointOfView(scene, view);
    const start = store.get().viewpoint;
    cancelAnimationFrame(this.animation);
    if (matchMedia("(prefers-reduced-motion: reduce)").matches || !this.canWarp()) {
      store.set({ viewpoint: target });
      return;
    }
    const begin = performance.now();
    const step = (now: number) => {
      const linear = Math.min(1, Math.max(0, (now - begin) / MOVE_MS));
      if (linear === 1) {
        store.set({ viewpoint: target });
        return;
      }
      const fraction = linear * linear * (3 - 2 * linear);
      store.set({ viewpoint: between(start, target, fraction) });
      this.animation = requestAnimationFrame(step);
    };
    this.animation = requestAnimationFrame(step);
  }

  /** To the next view in a direction, each −1 … 1. */
  byKey(right: number, down: number): void {
    const { scene, store } = this.session;
    const { view } = store.get().viewpoint;
    const next = neighbour(scene, view, right, down);
    if (next !== view) this.toView(next);
  }

  /** To a place of a parallel light field, in view steps. */
  toPlace(s: number, t: number): void {
    cancelAnimationFrame(this.animation);
    this.session.store.set({ viewpoint: viewpointAt(this.session.scene, s, t) });
  }

  /**
   * From `start`, dragged by (dx, dy) of the picture's width: the scene goes with the pointer, the
   * viewpoint the other way.
   */
  drag(start: Viewpoint, dx: number, dy: number): void {
    const { scene, store, usual } = this.session;
    cancelAnimationFrame(this.animation);
    if (isParallel(scene)) {
      const [s, t] = (["s", "t"] as const).map((axis) => {
        const places = scene.views.map((view) => view[axis]);
        const [low, high] = [Math.min(...places), Math.max(...places)];
        const moved = start[axis] - (axis === "s" ? dx : dy) * Math.min(12, 2 * (high - low));
        return Math.min(high, Math.max(low, moved));
      }) as [number, number];
      store.set({ viewpoint: viewpointAt(scene, s, t) });
      return;
    }
    // What lies in the middle of the depths stays under the pointer.
    const middle = (valueOfCode(usual[0], scene.value) + valueOfCode(usual[1], scene.value)) / 2;
    const { width, camera } = scene.views[start.view]!;
    const limit = 1.5 * this.spacing(start.view);
    const clamp = (x: number) => Math.min(limit, Math.max(-limit, x));
    const perWidth = width / camera.focal[0] / Math.max(middle, 1e-9);
    store.set({
      viewpoint: {
        ...start,
        camera: movedCamera(start.camera, clamp(-dx * perWidth), clamp(-dy * perWidth)),
        atView: false,
      },
    });
  }

  /** After a drag: to the view that is nearest. */
  settle(): void {
    const { scene, store } = this.session;
    const { viewpoint } = store.get();
    if (viewpoint.atView) return;
    if (isParallel(scene)) {
      this.toView(nearestView(scene, viewpoint.s, viewpoint.t));
      return;
    }
    const here = position(viewpoint.camera);
    const away = scene.views.map((view) => distance(position(view.camera), here));
    this.toView(away.indexOf(Math.min(...away)));
  }

  private canWarp(): boolean {
    return this.session.scene.views.some((view) => view.maps !== null);
  }

  /** Distance of the nearest other camera, scene units. */
  private spacing(view: number): number {
    const { views } = this.session.scene;
    const here = position(views[view]!.camera);
    const away = views
      .filter((_, idx) => idx !== view)
      .map((other) => distance(position(other.camera), here));
    return away.length === 0 ? 0.1 : Math.min(...away);
  }
}

function between(a: Viewpoint, b: Viewpoint, fraction: number): Viewpoint {
  return {
    s: a.s + (b.s - a.s) * fraction,
    t: a.t + (b.t - a.t) * fraction,
    camera: cameraBetween(a.camera, b.camera, fraction),
    view: b.view,
    atView: false,
  };
}
