// SPDX-License-Identifier: BSD-3-Clause
// All targets but the canvas have the picture's top row first: texel (u, v) is pixel (u, v).

const HEAD = `precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
`;

/** One triangle over the whole target. */
export const WHOLE_TARGET = `${HEAD}
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
}`;

const ENCODE = `
vec3 srgb_of_linear(vec3 x) {
  x = clamp(x, 0.0, 1.0);
  return mix(1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, x * 12.92, lessThanEqual(x, vec3(0.0031308)));
}
`;

const IN_INTERVAL = `
uniform uint near_code;
uniform uint far_code;
bool in_interval(uint code) {
  return code >= 1u && code >= far_code && code <= near_code;
}
`;

/** Picture (or the mean of refocus), overlay, interval and wipe of one view. */
export const COMPOSE = `${HEAD}${ENCODE}${IN_INTERVAL}
uniform sampler2D picture;         // sRGB; with 'sums' linear light summed, with its count in alpha
uniform usampler2D value;
uniform usampler2D other_value;
uniform usampler2D overlay;
uniform usampler2D other_overlay;
uniform sampler2D color_map;
uniform int sums;
uniform int overlay_on;
uniform int interval_on;
uniform float opacity;
uniform vec2 overlay_range;        // codes at the ends of the colour map
uniform uint none_code;
uniform float divider;             // px; right of it is the other result
out vec4 result;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 found = texelFetch(picture, pixel, 0);
  vec3 color = sums == 0 ? found.rgb : srgb_of_linear(found.rgb / max(found.a, 1.0));
  bool other = float(pixel.x) >= divider;
  uint code = other ? texelFetch(other_value, pixel, 0).r : texelFetch(value, pixel, 0).r;
  if (overlay_on == 1) {
    uint shown = other ? texelFetch(other_overlay, pixel, 0).r : texelFetch(overlay, pixel, 0).r;
    float place = (float(shown) - overlay_range.x) / (overlay_range.y - overlay_range.x);
    vec3 mapped = texelFetch(color_map, ivec2(int(clamp(place, 0.0, 1.0) * 255.0 + 0.5), 0), 0).rgb;
    color = mix(color, shown == none_code ? vec3(0.07) : mapped, opacity);
  }
  if (interval_on == 1 && !in_interval(code)) {
    color = vec3(dot(color, vec3(0.2126, 0.7152, 0.0722))) * 0.22;
  }
  result = vec4(color, 1.0);
}`;

/** 255 where the value belongs to the interval. */
export const MASK = `${HEAD}${IN_INTERVAL}
uniform usampler2D value;
out vec4 result;
void main() {
  result = vec4(in_interval(texelFetch(value, ivec2(gl_FragCoord.xy), 0).r) ? 1.0 : 0.0);
}`;

/** One point per pixel of a view, carried to where the viewpoint sees it. */
export const WARP_POINTS = `${HEAD}
uniform usampler2D value;
uniform sampler2D colors;
uniform int columns;               // points of a row
uniform int stride;                // px between points
uniform mat3 matrix;               // (U, V, Z) = matrix (u, v, 1) + value * vector
uniform vec3 vector;
uniform vec2 value_range;          // of the code
uniform vec2 depth_range;          // values at the far and the near end of the depth buffer
uniform vec2 target_size;          // px
uniform float point_size;          // px
flat out vec3 color;

void main() {
  ivec2 pixel = ivec2(gl_VertexID % columns, gl_VertexID / columns) * stride + stride / 2;
  pixel = min(pixel, textureSize(value, 0) - 1);
  uint code = texelFetch(value, pixel, 0).r;
  float w = value_range.x + (float(code) - 1.0) * (value_range.y - value_range.x) / 65534.0;
  vec3 place = matrix * vec3(pixel, 1.0) + w * vector;
  color = texelFetch(colors, pixel, 0).rgb;
  gl_PointSize = point_size;
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);    // clipped
  if (code == 0u || place.z <= 0.0) return;
  float nearness = (w / place.z - depth_range.x) / (depth_range.y - depth_range.x);
  vec2 position = (place.xy / place.z + 0.5) / target_size * 2.0 - 1.0;
  gl_Position = vec4(position, 1.0 - 2.0 * clamp(nearness, 0.0, 1.0), 1.0);
}`;

export const WARP_COLOR = `${HEAD}
flat in vec3 color;
out vec4 result;
void main() {
  result = vec4(color, 1.0);
}`;

/** Weighted mean of up to three warped views, of what lies at the front; what none sees is filled. */
export const COMBINE = `${HEAD}
uniform sampler2D colors_0;
uniform sampler2D colors_1;
uniform sampler2D colors_2;
uniform sampler2D depths_0;
uniform sampler2D depths_1;
uniform sampler2D depths_2;
uniform vec3 weights;              // 0 of views that aren't there
uniform float tolerance;           // of depths that are the same surface
uniform ivec2 size;
out vec4 result;

// Depth and colour of the front at a pixel; alpha 0 where no view sees anything.
vec4 front_at(ivec2 pixel, out float depth) {
  vec4 colors[3] = vec4[3](texelFetch(colors_0, pixel, 0), texelFetch(colors_1, pixel, 0),
                           texelFetch(colors_2, pixel, 0));
  vec3 depths = vec3(texelFetch(depths_0, pixel, 0).r, texelFetch(depths_1, pixel, 0).r,
                     texelFetch(depths_2, pixel, 0).r);
  depth = 1.0;
  for (int i = 0; i < 3; ++i) {
    if (weights[i] > 0.0 && colors[i].a > 0.0) depth = min(depth, depths[i]);
  }
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 3; ++i) {
    if (weights[i] > 0.0 && colors[i].a > 0.0 && depths[i] <= depth + tolerance) {
      sum += weights[i] * vec4(colors[i].rgb, 1.0);
    }
  }
  return sum.a > 0.0 ? sum / sum.a : vec4(0.0);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth;
  vec4 color = front_at(pixel, depth);
  // A hole shows what lies behind: of the nearest pixels around it, the farthest one.
  for (int radius = 1; radius <= 16 && color.a == 0.0; ++radius) {
    float farthest = -1.0;
    for (int i = 0; i < 8; ++i) {
      ivec2 step = ivec2(i < 3 ? -1 : i < 5 ? 0 : 1, i == 0 || i == 3 || i == 5 ? -1 : i == 1 || i == 6 ? 0 : 1);
      ivec2 beside = pixel + radius * step;
      if (any(lessThan(beside, ivec2(0))) || any(greaterThanEqual(beside, size))) continue;
      vec4 found = front_at(beside, depth);
      if (found.a > 0.0 && depth > farthest) {
        farthest = depth;
        color = found;
      }
    }
  }
  result = vec4(color.a > 0.0 ? color.rgb : vec3(0.07), 1.0);
}`;

/** What a view sees at a disparity from the pixels of the viewpoint, in linear light, count in alpha. */
export const REFOCUS = `${HEAD}
uniform sampler2D picture;
uniform mat3 matrix;
uniform vec3 vector;
uniform float value;
uniform ivec2 size;                // of the picture, px
out vec4 result;

void main() {
  vec3 seen = matrix * vec3(floor(gl_FragCoord.xy), 1.0) + value * vector;
  if (seen.z <= 0.0) discard;
  vec2 place = seen.xy / seen.z;
  vec2 last = vec2(size - 1);
  // Single precision may put what lies on the border beside it.
  const float slack = 1e-3;
  if (any(lessThan(place, vec2(-slack))) || any(greaterThan(place, last + slack))) discard;
  place = clamp(place, vec2(0.0), last);
  // By hand: the sampler's weights have 8 bits.
  ivec2 corner = min(ivec2(place), max(size - 2, 0));
  vec2 rest = place - vec2(corner);
  ivec2 next = min(corner + 1, size - 1);
  vec3 upper = mix(texelFetch(picture, corner, 0).rgb, texelFetch(picture, ivec2(next.x, corner.y), 0).rgb, rest.x);
  vec3 lower = mix(texelFetch(picture, ivec2(corner.x, next.y), 0).rgb, texelFetch(picture, next, 0).rgb, rest.x);
  result = vec4(mix(upper, lower, rest.y), 1.0);
}`;

/** To the canvas, whose bottom row is the first one. */
export const PRESENT = `${HEAD}
uniform sampler2D colors;
uniform int height;
out vec4 result;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  result = texelFetch(colors, ivec2(pixel.x, height - 1 - pixel.y), 0);
}`;
