// SPDX-License-Identifier: BSD-3-Clause

import type { CameraEntry } from "../scene/format";

export type Vec3 = [number, number, number];
/** 3 × 3, row major. */
export type Mat3 = number[];

/** Where something of one picture lies in another: (U, V, Z) = matrix (u, v, 1) + value * vector. */
export interface Transform {
  matrix: Mat3;
  vector: Vec3;
}

export function multiply(a: Mat3, b: Mat3): Mat3 {
  const c: Mat3 = [];
  for (let row = 0; row < 3; row++) {
    for (let col = 0; col < 3; col++) {
      c.push(a[3 * row]! * b[col]! + a[3 * row + 1]! * b[3 + col]! + a[3 * row + 2]! * b[6 + col]!);
    }
  }
  return c;
}

export function apply(a: Mat3, x: Vec3): Vec3 {
  return [0, 3, 6].map((row) => a[row]! * x[0] + a[row + 1]! * x[1] + a[row + 2]! * x[2]) as Vec3;
}

export function transpose(a: Mat3): Mat3 {
  return [a[0]!, a[3]!, a[6]!, a[1]!, a[4]!, a[7]!, a[2]!, a[5]!, a[8]!];
}

/** Pixels of camera coordinates. */
export function calibration(camera: CameraEntry): Mat3 {
  const { focal, centre } = camera;
  return [focal[0], 0, centre[0], 0, focal[1], centre[1], 0, 0, 1];
}

/** Rays (z = 1) of pixels. */
export function inverseCalibration(camera: CameraEntry): Mat3 {
  const { focal, centre } = camera;
  return [1 / focal[0], 0, -centre[0] / focal[0], 0, 1 / focal[1], -centre[1] / focal[1], 0, 0, 1];
}

/** Where the camera stands in the scene. */
export function position(camera: CameraEntry): Vec3 {
  return apply(transpose(camera.rotation), camera.translation).map((x) => -x) as Vec3;
}

/**
 * Where a pixel of `from` at inverse depth w (in `from`) is seen by `to` (eq. 10):
 * K' R' Rᵀ K⁻¹ (u, v, 1) + w K' (t' − R' Rᵀ t), there at inverse depth w / Z.
 */
export function transformBetween(from: CameraEntry, to: CameraEntry): Transform {
  const rotation = multiply(to.rotation, transpose(from.rotation));
  const turned = apply(rotation, from.translation);
  const shift = to.translation.map((x, i) => x - turned[i]!) as Vec3;
  return {
    matrix: multiply(calibration(to), multiply(rotation, inverseCalibration(from))),
    vector: apply(calibration(to), shift),
  };
}

/** The camera moved by `right` and `down` in its own axes, in scene units. */
export function movedCamera(camera: CameraEntry, right: number, down: number): CameraEntry {
  const [x, y, z] = camera.translation;
  return { ...camera, translation: [x - right, y - down, z] };
}

/** The camera `fraction` (0 … 1) of the way from `a` to `b`: straight, turning evenly. */
export function cameraBetween(a: CameraEntry, b: CameraEntry, fraction: number): CameraEntry {
  const mix = (x: number, y: number) => x + (y - x) * fraction;
  const pa = position(a);
  const pb = position(b);
  const at = pa.map((x, i) => mix(x, pb[i]!)) as Vec3;
  const rotation = orthonormal(a.rotation.map((x, i) => mix(x, b.rotation[i]!)));
  return {
    focal: [mix(a.focal[0], b.focal[0]), mix(a.focal[1], b.focal[1])],
    centre: [mix(a.centre[0], b.centre[0]), mix(a.centre[1], b.centre[1])],
    rotation,
    translation: apply(rotation, at).map((x) => -x) as Vec3,
  };
}

/** A rotation near a matrix: its axis z is kept, x made orthogonal to it. */
function orthonormal(a: Mat3): Mat3 {
  const z = unit([a[6]!, a[7]!, a[8]!]);
  const along = a[0]! * z[0] + a[1]! * z[1] + a[2]! * z[2];
  const x = unit([a[0]! - along * z[0], a[1]! - along * z[1], a[2]! - along * z[2]]);
  const y: Vec3 = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]];
  return [...x, ...y, ...z];
}

function unit(x: Vec3): Vec3 {
  const length = Math.hypot(...x);
  return x.map((value) => value / length) as Vec3;
}

export function distance(a: Vec3, b: Vec3): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
