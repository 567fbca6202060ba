// SPDX-License-Identifier: BSD-3-Clause

import type { Transform } from "../math/camera";
import type { Interval } from "../math/interval";
import type { Range } from "../scene/format";
import { Program, type Uniforms } from "./program";
import * as shaders from "./shaders";
import { Target, type TargetFormat } from "./target";
import { TextureCache } from "./textures";

/** Textures of pictures and maps that are kept on the graphics card. */
const TEXTURE_BYTES = 512 << 20;

/** Points are a little larger than a pixel, so that rounding leaves no cracks. */
const POINT_SIZE_PX = 1.5;

export interface ComposeInput {
  /** As it is stored, or a target of sums of linear light. */
  picture: WebGLTexture;
  isSum: boolean;
  value: WebGLTexture | null;
  otherValue: WebGLTexture | null;
  overlay: {
    codes: WebGLTexture | null;
    otherCodes: WebGLTexture | null;
    colorMap: WebGLTexture;
    /** Codes at the ends of the colour map. */
    range: [number, number];
    /** Code of pixels without an estimate. */
    none: number;
    /** 0 … 1 */
    opacity: number;
  } | null;
  interval: Interval | null;
  /** px; right of it the other result is shown */
  divider: number;
}

/** A composed view and how its pixels move to the viewpoint. */
export interface WarpInput {
  colors: WebGLTexture;
  value: WebGLTexture;
  width: number;
  height: number;
  transform: Transform;
  /** Of all inputs together 1. */
  weight: number;
}

/** Draws pictures, maps, warped views and refocus; all that it holds dies with its context. */
export class Renderer {
  readonly textures: TextureCache;
  private readonly programs: Record<
    "compose" | "mask" | "warp" | "combine" | "refocus" | "present",
    Program
  >;
  private readonly targets = new Map<string, Target>();
  private readonly composedNames = ["composed 0", "composed 1", "composed 2", "composed 3"];
  private readonly composedKeys = ["", "", "", ""];
  private readonly noCodes: WebGLTexture;

  constructor(readonly gl: WebGL2RenderingContext) {
    const whole = (fragment: string) => new Program(gl, shaders.WHOLE_TARGET, fragment);
    this.textures = new TextureCache(gl, TEXTURE_BYTES);
    this.programs = {
      compose: whole(shaders.COMPOSE),
      mask: whole(shaders.MASK),
      warp: new Program(gl, shaders.WARP_POINTS, shaders.WARP_COLOR),
      combine: whole(shaders.COMBINE),
      refocus: whole(shaders.REFOCUS),
      present: whole(shaders.PRESENT),
    };
    this.noCodes = this.textures.codes("none", new Uint8Array(1), 1, 1);
    gl.disable(gl.DITHER);
  }

  /** The target of a name, made anew where its size changes. */
  target(name: string, width: number, height: number, format: TargetFormat): Target {
    const kept = this.targets.get(name);
    if (kept?.width === width && kept.height === height) return kept;
    kept?.delete();
    const target = new Target(this.gl, width, height, format);
    this.targets.set(name, target);
    return target;
  }

  /** The target of one composed view: that with the key where there is one, else the oldest. */
  composed(key: string, width: number, height: number): { target: Target; isDrawn: boolean } {
    const kept = this.composedKeys.indexOf(key);
    const slot = Math.max(kept, 0);
    const [name] = this.composedNames.splice(slot, 1);
    this.composedKeys.splice(slot, 1);
    // The last one was used last.
    this.composedNames.push(name!);
    this.composedKeys.push(key);
    return { target: this.target(name!, width, height, "color"), isDrawn: kept >= 0 };
  }

  /** Picture with overlay, interval and wipe. */
  compose(target: Target, input: ComposeInput): void {
    const { overlay, interval } = input;
    const code = (texture: WebGLTexture | null | undefined) => ({
      texture: texture ?? this.noCodes,
    });
    target.bind();
    this.drawWhole(this.programs.compose, {
      picture: { texture: input.picture },
      value: code(input.value),
      other_value: code(input.otherValue),
      overlay: code(overlay?.codes),
      other_overlay: code(overlay?.otherCodes),
      color_map: { texture: overlay?.colorMap ?? input.picture },
      sums: { int: input.isSum ? 1 : 0 },
      overlay_on: { int: overlay === null ? 0 : 1 },
      interval_on: { int: interval === null ? 0 : 1 },
      opacity: overlay?.opacity ?? 0,
      overlay_range: overlay?.range ?? [0, 1],
      none_code: { uint: overlay?.none ?? 0 },
      near_code: { uint: interval?.near ?? 0 },
      far_code: { uint: interval?.far ?? 0 },
      divider: input.divider,
    });
  }

  /** 255 in all channels where the value belongs to the interval, else 0. */
  mask(target: Target, value: WebGLTexture, interval: Interval): void {
    target.bind();
    this.drawWhole(this.programs.mask, {
      value: { texture: value },
      near_code: { uint: interval.near },
      far_code: { uint: interval.far },
    });
  }

  /**
   * The views as seen from the viewpoint that their transforms go to, one point for `stride` × `stride`
   * pixels. `size` is that of the viewpoint's picture, px; the target may be smaller.
   */
  warp(
    target: Target,
    inputs: WarpInput[],
    value: Range,
    parallel: boolean,
    stride: number,
    size: [number, number],
  ): void {
    const { gl } = this;
    const span = value.max - value.min;
    // Of posed cameras the inverse depth changes on the way; of parallel ones it stays.
    const range = [value.min - 0.01 * span, parallel ? value.max + 0.01 * span : 2 * value.max];
    const warped = inputs.slice(0, 3).map((input, idx) => {
      const into = this.target(`warped ${idx}`, target.width, target.height, "color and depth");
      const columns = Math.ceil(input.width / stride);
      into.clear();
      gl.enable(gl.DEPTH_TEST);
      this.programs.warp.use({
        value: { texture: input.value },
        colors: { texture: input.colors },
        columns: { int: columns },
        stride: { int: stride },
        matrix: { mat3: input.transform.matrix },
        vector: input.transform.vector,
        value_range: [value.min, value.max],
        depth_range: range,
        // The whole picture's, whatever the target's: a coarse one shows the same.
        target_size: size,
        point_size: POINT_SIZE_PX,
      });
      gl.drawArrays(gl.POINTS, 0, columns * Math.ceil(input.height / stride));
      gl.disable(gl.DEPTH_TEST);
      return into;
    });
    const at = (idx: number) => warped[Math.min(idx, warped.length - 1)]!;
    target.bind();
    this.drawWhole(
      this.programs.combine,
      {
        colors_0: { texture: at(0).color },
        colors_1: { texture: at(1).color },
        colors_2: { texture: at(2).color },
        depths_0: { texture: at(0).depth! },
        depths_1: { texture: at(1).depth! },
        depths_2: { texture: at(2).depth! },
        weights: [0, 1, 2].map((idx) => inputs[idx]?.weight ?? 0),
        tolerance: 0.02,
      },
      { size: [target.width, target.height] },
    );
  }

  /** Adds what a picture shows at `value` from the pixels of the viewpoint; the target is of sums. */
  addRefocused(
    target: Target,
    picture: WebGLTexture,
    size: [number, number],
    transform: Transform,
    value: number,
  ): void {
    const { gl } = this;
    target.bind();
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    this.drawWhole(
      this.programs.refocus,
      {
        picture: { texture: picture },
        matrix: { mat3: transform.matrix },
        vector: transform.vector,
        value,
      },
      { size },
    );
    gl.disable(gl.BLEND);
  }

  /** Shows a target on the canvas, whose size becomes that of the target. */
  present(target: Target): void {
    const { gl } = this;
    const canvas = gl.canvas as HTMLCanvasElement;
    if (canvas.width !== target.width) canvas.width = target.width;
    if (canvas.height !== target.height) canvas.height = target.height;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, target.width, target.height);
    this.drawWhole(this.programs.present, {
      colors: { texture: target.color },
      height: { int: target.height },
    });
  }

  private drawWhole(
    program: Program,
    uniforms: Uniforms,
    ints: Record<string, number[]> = {},
  ): void {
    program.use(uniforms);
    for (const [name, value] of Object.entries(ints)) program.setInts(name, value);
    this.gl.drawArrays(this.gl.TRIANGLES, 0, 3);
  }
}
