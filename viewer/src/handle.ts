// SPDX-License-Identifier: BSD-3-Clause
// `window.gigaray`: the page's state for tests, and for readers who open the console.

import type { Pixels } from "./gl/stage";
import type { Page } from "./page";
import type { Scene } from "./scene/format";
import { type PixelValues, pixelValues } from "./state/pixel_values";
import type { ViewState } from "./state/view_state";

export interface Handle {
  scene: Scene;
  /** What the page shows now. */
  readonly state: Readonly<ViewState>;
  /** Changes what the page shows, and waits until it does. */
  set(changes: Partial<ViewState>): Promise<void>;
  /** Goes to a view by its index, and waits until it is shown. */
  show(view: number): Promise<void>;
  /** What the maps of the present view hold at a pixel (px shown). */
  valueAt(u: number, v: number): Promise<PixelValues | null>;
  /** The present interval's mask of the present view: 255 inside, read back from WebGL. */
  mask(): Promise<Pixels>;
  /** The picture at the present focus and aperture, RGBA, read back from WebGL. */
  refocused(): Promise<Pixels>;
  /** What the canvas shows, RGBA, without the overlay of the cursor. */
  shown(): Promise<Pixels>;
  /** Resolves when the page shows its state. */
  idle(): Promise<void>;
  /** Frames that were drawn so far. */
  readonly frames: number;
}

declare global {
  interface Window {
    gigaray: Handle & { ready: Promise<void> };
  }
}

/** Before the scene is read there is `ready` alone; it fails with the line that the page shows. */
export function publishFailure(ready: Promise<void>): void {
  window.gigaray = { ready } as Window["gigaray"];
}

/** Adds the rest of the handle. */
export function publishHandle(page: Page): void {
  const { session, stage, moves } = page;
  const { store, scene } = session;
  const here = () => store.get().viewpoint.view;
  const handle: Handle = {
    scene,
    get state() {
      return store.get();
    },
    get frames() {
      return stage.frames;
    },
    set: (changes) => {
      store.set(changes);
      return stage.idle();
    },
    show: async (view) => {
      moves.toView(view);
      while (!store.get().viewpoint.atView || here() !== view) await stage.idle();
      await stage.idle();
    },
    valueAt: (u, v) => pixelValues(session, { view: here(), u, v }),
    mask: () => stage.mask(here()),
    refocused: () => stage.refocused(),
    shown: () => stage.shown(),
    idle: () => stage.idle(),
  };
  window.gigaray = Object.defineProperties(
    window.gigaray ?? { ready: Promise.resolve() },
    Object.getOwnPropertyDescriptors(handle),
  ) as Handle & { ready: Promise<void> };
}
