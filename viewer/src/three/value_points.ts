// SPDX-License-Identifier: BSD-3-Clause
// Points of a view's map of values: one vertex a pixel, placed in the vertex shader.

import {
  BufferGeometry,
  ClampToEdgeWrapping,
  DataTexture,
  GLSL3,
  Matrix3,
  NearestFilter,
  Points,
  RedIntegerFormat,
  ShaderMaterial,
  SRGBColorSpace,
  Texture,
  UnsignedByteType,
  UnsignedShortType,
  Vector2,
  Vector3,
} from "three";
import { inverseCalibration, multiply, position, transpose } from "../math/camera";
import { MAX_CODE } from "../math/codes";
import type { Interval } from "../math/interval";
import type { Scene } from "../scene/format";
import type { Codes } from "../scene/scene_data";

const VERTEX = `
precision highp usampler2D;
uniform usampler2D value;
uniform usampler2D confidence;
uniform sampler2D picture;
uniform int width;
uniform vec2 value_range;
uniform vec2 inverse_depth;      // per value, at zero
uniform mat3 scene_from_pixel;   // direction with z = 1 in the camera
uniform vec3 camera_position;
uniform float least_confidence;  // code; 0 where there is no map
uniform uint near_code;          // of the interval
uniform uint far_code;
uniform float size;              // px at distance 1
out vec3 color;

void main() {
  ivec2 pixel = ivec2(gl_VertexID % width, gl_VertexID / width);
  uint code = texelFetch(value, pixel, 0).r;
  float w = value_range.x + (float(code) - 1.0) * (value_range.y - value_range.x) / 65534.0;
  float inverse = inverse_depth.x * w + inverse_depth.y;
  color = texelFetch(picture, pixel, 0).rgb;
  gl_PointSize = 1.0;
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  bool sure = least_confidence <= 0.0 || float(texelFetch(confidence, pixel, 0).r) >= least_confidence;
  bool inside = code >= 1u && code >= far_code && code <= near_code;
  if (!inside || inverse <= 0.0 || !sure) return;
  vec3 place = camera_position + scene_from_pixel * vec3(pixel, 1.0) / inverse;
  vec4 seen = modelViewMatrix * vec4(place, 1.0);
  gl_Position = projectionMatrix * seen;
  // As large as the pixel is there, so that surfaces close.
  gl_PointSize = clamp(size / inverse / -seen.z, 1.0, 24.0);
}`;

const FRAGMENT = `
in vec3 color;
out vec4 result;
vec3 srgb_of_linear(vec3 x) {
  return mix(1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, x * 12.92, lessThanEqual(x, vec3(0.0031308)));
}
void main() {
  result = vec4(srgb_of_linear(color), 1.0);
}`;

/** The points of a view. `setShown` goes before each draw. */
export function valuePoints(
  scene: Scene,
  view: number,
  picture: ImageBitmap,
  value: Codes,
  confidence: Codes | null,
): Points<BufferGeometry, ShaderMaterial> {
  const { camera, width, height } = scene.views[view]!;
  const geometry = new BufferGeometry();
  geometry.setDrawRange(0, width * height);
  const directions = multiply(transpose(camera.rotation), inverseCalibration(camera));
  const material = new ShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: {
      value: { value: codesTexture(value, width, height) },
      confidence: {
        value: codesTexture(
          confidence ?? new Uint8Array(1),
          confidence ? width : 1,
          confidence ? height : 1,
        ),
      },
      picture: { value: pictureTexture(picture) },
      width: { value: width },
      value_range: { value: new Vector2(scene.value.min, scene.value.max) },
      inverse_depth: {
        value: new Vector2(scene.inverse_depth.per_value, scene.inverse_depth.at_zero),
      },
      scene_from_pixel: { value: new Matrix3().fromArray(transpose(directions)) },
      camera_position: { value: new Vector3(...position(camera)) },
      least_confidence: { value: 0 },
      near_code: { value: MAX_CODE },
      far_code: { value: 1 },
      size: { value: 1 },
    },
  });
  material.userData = { focal: camera.focal[0], hasConfidence: confidence !== null };
  const points = new Points(geometry, material);
  points.frustumCulled = false;
  return points;
}

/**
 * Tells the points how large they appear and which are drawn. `focalPx` is that of the eye in px of
 * its picture; `confidence` is 0 … 1.
 */
export function setShown(
  points: Points<BufferGeometry, ShaderMaterial>,
  focalPx: number,
  confidence: number,
  interval: Interval | null,
): void {
  const { uniforms, userData } = points.material;
  uniforms.size!.value = (1.4 * focalPx) / userData.focal;
  uniforms.least_confidence!.value = userData.hasConfidence ? 255 * confidence : 0;
  uniforms.near_code!.value = interval?.near ?? MAX_CODE;
  uniforms.far_code!.value = interval?.far ?? 1;
}

/** Frees what the points hold on the graphics card. */
export function disposePoints(points: Points<BufferGeometry, ShaderMaterial>): void {
  for (const name of ["value", "confidence", "picture"]) {
    (points.material.uniforms[name]!.value as Texture).dispose();
  }
  points.material.dispose();
  points.geometry.dispose();
}

function codesTexture(codes: Codes, width: number, height: number): DataTexture {
  const wide = codes instanceof Uint16Array;
  const type = wide ? UnsignedShortType : UnsignedByteType;
  const texture = new DataTexture(codes, width, height, RedIntegerFormat, type);
  texture.internalFormat = wide ? "R16UI" : "R8UI";
  texture.unpackAlignment = 1;
  texture.needsUpdate = true;
  return texture;
}

function pictureTexture(picture: ImageBitmap): Texture {
  const texture = new Texture(picture);
  texture.colorSpace = SRGBColorSpace;
  texture.flipY = false;
  texture.generateMipmaps = false;
  texture.minFilter = NearestFilter;
  texture.magFilter = NearestFilter;
  texture.wrapS = ClampToEdgeWrapping;
  texture.wrapT = ClampToEdgeWrapping;
  texture.needsUpdate = true;
  return texture;
}
