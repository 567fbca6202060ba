// SPDX-License-Identifier: BSD-3-Clause

/** Values of uniforms by name: numbers are floats, the rest says what it is. */
export type Uniforms = Record<
  string,
  | number
  | readonly number[]
  | { int: number }
  | { uint: number }
  | { mat3: readonly number[] }
  | { texture: WebGLTexture }
>;

/** A linked program that sets its uniforms by name. */
export class Program {
  private readonly program: WebGLProgram;
  private readonly locations = new Map<string, WebGLUniformLocation | null>();

  /** Throws with the compiler's message; null results of a lost context pass. */
  constructor(
    private readonly gl: WebGL2RenderingContext,
    vertex: string,
    fragment: string,
  ) {
    this.program = gl.createProgram() as WebGLProgram;
    for (const [type, source] of [
      [gl.VERTEX_SHADER, vertex],
      [gl.FRAGMENT_SHADER, fragment],
    ] as const) {
      const shader = gl.createShader(type) as WebGLShader;
      gl.shaderSource(shader, `#version 300 es\n${source}`);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) {
        throw new Error(`shader: ${gl.getShaderInfoLog(shader)}`);
      }
      gl.attachShader(this.program, shader);
    }
    gl.linkProgram(this.program);
    if (!gl.getProgramParameter(this.program, gl.LINK_STATUS) && !gl.isContextLost()) {
      throw new Error(`program: ${gl.getProgramInfoLog(this.program)}`);
    }
  }

  /** Makes it current and sets all uniforms given; textures get units in their order. */
  use(uniforms: Uniforms): void {
    const { gl } = this;
    gl.useProgram(this.program);
    let unit = 0;
    for (const [name, value] of Object.entries(uniforms)) {
      const location = this.location(name);
      if (typeof value === "number") gl.uniform1f(location, value);
      else if (Array.isArray(value)) this.setVector(location, value);
      else if ("int" in value) gl.uniform1i(location, value.int);
      else if ("uint" in value) gl.uniform1ui(location, value.uint);
      // Row major here, column major there: `transpose` is allowed in WebGL2.
      else if ("mat3" in value) gl.uniformMatrix3fv(location, true, value.mat3);
      else if ("texture" in value) {
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, value.texture);
        gl.uniform1i(location, unit++);
      }
    }
  }

  /** Sets a vector of two integers. */
  setInts(name: string, value: readonly number[]): void {
    this.gl.uniform2iv(this.location(name), value);
  }

  private setVector(location: WebGLUniformLocation | null, value: readonly number[]): void {
    if (value.length === 2) this.gl.uniform2fv(location, value);
    else if (value.length === 3) this.gl.uniform3fv(location, value);
    else this.gl.uniform4fv(location, value);
  }

  private location(name: string): WebGLUniformLocation | null {
    let location = this.locations.get(name);
    if (location === undefined) {
      location = this.gl.getUniformLocation(this.program, name);
      this.locations.set(name, location);
    }
    return location;
  }
}
