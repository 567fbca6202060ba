// SPDX-License-Identifier: BSD-3-Clause

import type { Codes } from "../scene/scene_data";

/** Textures of pictures and maps by key; beyond a budget the one used longest ago is dropped. */
export class TextureCache {
  private readonly entries = new Map<string, { texture: WebGLTexture; bytes: number }>();
  private bytes = 0;

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly budget: number,
  ) {}

  /** A picture as it is stored, for showing it. */
  picture(key: string, bitmap: ImageBitmap): WebGLTexture {
    return this.rgba(`picture ${key}`, bitmap, this.gl.RGBA8);
  }

  /** A picture that samplers read as linear light, for means. */
  light(key: string, bitmap: ImageBitmap): WebGLTexture {
    return this.rgba(`light ${key}`, bitmap, this.gl.SRGB8_ALPHA8);
  }

  /** Codes as integers, so that nothing is rounded. */
  codes(key: string, codes: Codes, width: number, height: number): WebGLTexture {
    const { gl } = this;
    const wide = codes instanceof Uint16Array;
    const format = wide ? gl.R16UI : gl.R8UI;
    const type = wide ? gl.UNSIGNED_SHORT : gl.UNSIGNED_BYTE;
    return this.get(key, codes.byteLength, () =>
      gl.texImage2D(gl.TEXTURE_2D, 0, format, width, height, 0, gl.RED_INTEGER, type, codes),
    );
  }

  /** RGBA bytes of one row. */
  row(key: string, rgba: Uint8Array): WebGLTexture {
    const { gl } = this;
    return this.get(key, rgba.length, () =>
      gl.texImage2D(
        gl.TEXTURE_2D,
        0,
        gl.RGBA8,
        rgba.length / 4,
        1,
        0,
        gl.RGBA,
        gl.UNSIGNED_BYTE,
        rgba,
      ),
    );
  }

  private rgba(key: string, bitmap: ImageBitmap, format: number): WebGLTexture {
    const { gl } = this;
    return this.get(key, 4 * bitmap.width * bitmap.height, () =>
      gl.texImage2D(gl.TEXTURE_2D, 0, format, gl.RGBA, gl.UNSIGNED_BYTE, bitmap),
    );
  }

  private get(key: string, bytes: number, upload: () => void): WebGLTexture {
    const { gl } = this;
    const kept = this.entries.get(key);
    if (kept !== undefined) {
      this.entries.delete(key);
      this.entries.set(key, kept);
      return kept.texture;
    }
    const texture = newTexture(gl);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    upload();
    this.entries.set(key, { texture, bytes });
    this.bytes += bytes;
    for (const [oldest, entry] of this.entries) {
      // The last few are those of the draw that is being prepared.
      if (this.bytes <= this.budget || this.entries.size <= 12) break;
      this.gl.deleteTexture(entry.texture);
      this.entries.delete(oldest);
      this.bytes -= entry.bytes;
    }
    return texture;
  }
}

/** A bound texture that is read texel by texel. */
export function newTexture(gl: WebGL2RenderingContext): WebGLTexture {
  const texture = gl.createTexture() as WebGLTexture;
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  return texture;
}
