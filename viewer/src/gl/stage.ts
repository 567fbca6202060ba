// SPDX-License-Identifier: BSD-3-Clause

import type { Session } from "../state/session";
import { codesTexture, drawFrame, refocus } from "./frame";
import { Renderer } from "./renderer";

/** Bytes of a picture or mask, row by row from the top. */
export interface Pixels {
  width: number;
  height: number;
  bytes: Uint8Array<ArrayBuffer>;
}

/** Frames of warped views that take longer, or less, make the next ones coarser, or finer. */
const SLOW_MS = 45;
const FAST_MS = 12;
const MOST_STRIDE = 4;
/** After a movement's last frame. */
const REFINE_MS = 200;

/** The canvas with the picture: draws after changes, one frame at a time, and outlives its context. */
export class Stage {
  private renderer: Renderer | null = null;
  private wanted = false;
  /** Draws and reads share targets: each waits for the one before. */
  private queue: Promise<void> = Promise.resolve();
  /** Pixels that one warped point stands for, across and down. */
  private stride = 1;
  /** The next frame is drawn finely: the movement is over. */
  private isFine = false;
  private refinement = 0;
  /** Frames that were drawn. */
  frames = 0;

  private constructor(
    private readonly gl: WebGL2RenderingContext,
    readonly canvas: HTMLCanvasElement,
    private readonly session: Session,
  ) {
    canvas.addEventListener("webglcontextlost", (event) => {
      // Without this the browser would never give the context back.
      event.preventDefault();
      this.renderer = null;
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.renderer = new Renderer(gl);
      this.redraw();
    });
    this.renderer = new Renderer(gl);
    session.store.subscribe((state, before) => {
      const { hovered: _h, picked: _p, click: _c, delta: _d, ...shown } = state;
      if (
        (Object.keys(shown) as (keyof typeof shown)[]).some((key) => state[key] !== before[key])
      ) {
        this.redraw();
      }
    });
  }

  /** Null where the browser has no WebGL2. */
  static create(canvas: HTMLCanvasElement, session: Session): Stage | null {
    const gl = canvas.getContext("webgl2", { alpha: false, antialias: false, depth: false });
    return gl === null ? null : new Stage(gl, canvas, session);
  }

  /** Draws before the next repaint; many calls make one frame. */
  redraw(): void {
    clearTimeout(this.refinement);
    if (this.wanted) return;
    this.wanted = true;
    requestAnimationFrame(() => {
      void this.exclusively(async (renderer) => {
        this.wanted = false;
        await this.drawInTime(renderer);
        this.frames++;
        this.session.report(null);
      }).catch((reason) => {
        if (!this.gl.isContextLost()) this.session.report(reason);
      });
    });
  }

  /** Draws more coarsely while views are warped too slowly, and finely after the movement. */
  private async drawInTime(renderer: Renderer): Promise<void> {
    const { gl } = this;
    const state = this.session.store.get();
    if (state.viewpoint.atView) {
      await drawFrame(renderer, this.session, state);
      return;
    }
    const begin = performance.now();
    const drawn = this.isFine ? 1 : this.stride;
    this.isFine = false;
    await drawFrame(renderer, this.session, state, drawn);
    // Reading a pixel waits for the draw; without it the time would be that of its orders alone.
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    const time = performance.now() - begin;
    if (time > SLOW_MS) this.stride = Math.min(MOST_STRIDE, Math.max(this.stride, drawn + 1));
    else if (time < FAST_MS) this.stride = Math.max(1, drawn - 1);
    if (drawn === 1) return;
    this.refinement = window.setTimeout(() => {
      this.isFine = true;
      this.redraw();
    }, REFINE_MS);
  }

  /** Resolves when no frame is wanted or being drawn. */
  async idle(): Promise<void> {
    do {
      await new Promise((resolve) => setTimeout(resolve, 10));
      await this.queue;
    } while (this.wanted || this.renderer === null);
  }

  /** The mask of the present interval over a view: 255 inside, one byte a pixel. */
  async mask(view: number): Promise<Pixels> {
    const { width, height } = this.session.scene.views[view]!;
    const rgba = await this.exclusively(async (renderer) => {
      const value = await codesTexture(renderer, this.session, view, "value", "own");
      const target = renderer.target("mask", width, height, "color");
      renderer.mask(target, value, this.session.store.get().interval);
      return target.read();
    });
    const bytes = new Uint8Array(width * height);
    for (let i = 0; i < bytes.length; i++) bytes[i] = rgba[4 * i]!;
    return { width, height, bytes };
  }

  /** What the present focus and aperture show, RGBA. */
  async refocused(): Promise<Pixels> {
    const state = this.session.store.get();
    const { width, height } = this.session.scene.views[state.viewpoint.view]!;
    const bytes = await this.exclusively(async (renderer) => {
      const sums = await refocus(renderer, this.session, state);
      const target = renderer.target("read", width, height, "color");
      renderer.compose(target, {
        picture: sums.color,
        isSum: true,
        value: null,
        otherValue: null,
        overlay: null,
        interval: null,
        divider: 1e9,
      });
      return target.read();
    });
    return { width, height, bytes };
  }

  /** What the canvas shows, RGBA. */
  async shown(): Promise<Pixels> {
    return this.exclusively(async (renderer) => {
      const target = await drawFrame(renderer, this.session, this.session.store.get());
      if (target === null) return { width: 0, height: 0, bytes: new Uint8Array() };
      return { width: target.width, height: target.height, bytes: target.read() };
    });
  }

  /** Runs `draw` alone. Where the context is lost it does so after it came back. */
  private exclusively<T>(draw: (renderer: Renderer) => Promise<T>): Promise<T> {
    const run = this.queue.then(async () => {
      while (this.renderer === null) await new Promise((resolve) => setTimeout(resolve, 20));
      return draw(this.renderer);
    });
    this.queue = run.then(
      () => {},
      () => {},
    );
    return run;
  }
}
