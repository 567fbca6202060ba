// SPDX-License-Identifier: BSD-3-Clause

import { newTexture } from "./textures";

export type TargetFormat = "color" | "color and depth" | "sums";

/** A picture that is drawn to and then read as a texture; its top row is the first one. */
export class Target {
  readonly color: WebGLTexture;
  readonly depth: WebGLTexture | null = null;
  private readonly framebuffer: WebGLFramebuffer;

  constructor(
    private readonly gl: WebGL2RenderingContext,
    readonly width: number,
    readonly height: number,
    format: TargetFormat,
  ) {
    this.framebuffer = gl.createFramebuffer() as WebGLFramebuffer;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
    this.color = newTexture(gl);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format === "sums" ? sumFormat(gl) : gl.RGBA8, width, height);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.color, 0);
    if (format === "color and depth") {
      this.depth = newTexture(gl);
      gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, width, height);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.depth, 0);
    }
  }

  /** Makes it the target of draws. */
  bind(): void {
    this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, this.framebuffer);
    this.gl.viewport(0, 0, this.width, this.height);
  }

  clear(): void {
    const { gl } = this;
    this.bind();
    gl.clearColor(0, 0, 0, 0);
    gl.clearDepth(1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  }

  /** RGBA bytes, row by row from the top. */
  read(): Uint8Array<ArrayBuffer> {
    const { gl } = this;
    const rgba = new Uint8Array(4 * this.width * this.height);
    this.bind();
    gl.pixelStorei(gl.PACK_ALIGNMENT, 1);
    gl.readPixels(0, 0, this.width, this.height, gl.RGBA, gl.UNSIGNED_BYTE, rgba);
    return rgba;
  }

  delete(): void {
    this.gl.deleteTexture(this.color);
    this.gl.deleteTexture(this.depth);
    this.gl.deleteFramebuffer(this.framebuffer);
  }
}

/** The finest format that sums can be blended into. */
function sumFormat(gl: WebGL2RenderingContext): number {
  const full = gl.getExtension("EXT_color_buffer_float") !== null;
  const blends = gl.getExtension("EXT_float_blend") !== null;
  if (full && blends) return gl.RGBA32F;
  if (full || gl.getExtension("EXT_color_buffer_half_float") !== null) return gl.RGBA16F;
  throw new Error("this browser cannot draw to floating-point pictures, which refocus needs");
}
