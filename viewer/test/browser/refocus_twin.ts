// SPDX-License-Identifier: BSD-3-Clause

import { apply } from "../../src/math/camera";
import { linearOfSrgb, srgbOfLinear } from "../../src/math/srgb";
import { transformFor, viewpointOfView } from "../../src/math/viewpoint";
import type { Fixture } from "../fixture/scenes";

/** The formula of refocus over the fixture's pictures in double precision: RGB, 0 … 255. */
export function refocusTwin(
  { scene, views }: Fixture,
  view: number,
  value: number,
  aperture: number,
): Float64Array {
  const here = scene.views[view]!;
  const { width, height } = here;
  const linear = Float64Array.from({ length: 256 }, (_, byte) => linearOfSrgb(byte / 255));
  const sums = new Float64Array(4 * width * height);
  scene.views.forEach((entry, idx) => {
    if (Math.hypot(entry.s - here.s, entry.t - here.t) > aperture) return;
    const transform = transformFor(
      scene,
      viewpointOfView(scene, view),
      viewpointOfView(scene, idx),
    );
    const { rgb } = views[idx]!;
    for (let v = 0; v < height; v++) {
      for (let u = 0; u < width; u++) {
        const seen = apply(transform.matrix, [u, v, 1]).map(
          (x, i) => x + value * transform.vector[i]!,
        );
        const [x, y] = [seen[0]! / seen[2]!, seen[1]! / seen[2]!];
        if (x < 0 || y < 0 || x > width - 1 || y > height - 1) continue;
        const [left, top] = [
          Math.min(width - 2, Math.floor(x)),
          Math.min(height - 2, Math.floor(y)),
        ];
        const [a, b] = [x - left, y - top];
        const i = 4 * (v * width + u);
        for (let c = 0; c < 3; c++) {
          const at = (du: number, dv: number) =>
            linear[rgb[3 * ((top + dv) * width + left + du) + c]!]!;
          const upper = (1 - a) * at(0, 0) + a * at(1, 0);
          const lower = (1 - a) * at(0, 1) + a * at(1, 1);
          sums[i + c]! += (1 - b) * upper + b * lower;
        }
        sums[i + 3]! += 1;
      }
    }
  });
  const out = new Float64Array(3 * width * height);
  for (let i = 0; i < width * height; i++) {
    for (let c = 0; c < 3; c++) {
      const count = sums[4 * i + 3]!;
      out[3 * i + c] = count === 0 ? 0 : 255 * srgbOfLinear(sums[4 * i + c]! / count);
    }
  }
  return out;
}
