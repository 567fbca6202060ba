// SPDX-License-Identifier: BSD-3-Clause

import assert from "node:assert/strict";
import { test } from "node:test";
import {
  apply,
  cameraBetween,
  movedCamera,
  position,
  transformBetween,
  type Vec3,
} from "../../src/math/camera";
import { nearestMaps, transformFor, viewpointAt, viewpointOfView } from "../../src/math/viewpoint";
import type { CameraEntry } from "../../src/scene/format";
import { makeFixture } from "../fixture/scenes";

function near(actual: readonly number[], expected: readonly number[]): void {
  assert.equal(actual.length, expected.length);
  actual.forEach((x, i) => {
    assert.ok(Math.abs(x - expected[i]!) < 1e-9, `${actual} instead of ${expected}`);
  });
}

function seen(from: CameraEntry, to: CameraEntry, u: number, v: number, w: number): number[] {
  const { matrix, vector } = transformBetween(from, to);
  const [x, y, z] = apply(matrix, [u, v, 1]).map((value, i) => value + w * vector[i]!) as Vec3;
  return [x / z, y / z, w / z];
}

const STRAIGHT: CameraEntry = {
  focal: [100, 200],
  centre: [50, 40],
  rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1],
  translation: [0, 0, 0],
};

test("a camera one to the right sees a point at depth 4 a quarter of the focal length to the left", () => {
  const right = { ...STRAIGHT, translation: [-1, 0, 0] as Vec3 };
  near(seen(STRAIGHT, right, 60, 44, 0.25), [35, 44, 0.25]);
  near(position(right), [1, 0, 0]);
});

test("a camera one ahead sees a point at depth 4 at depth 3, farther from the centre", () => {
  const ahead = { ...STRAIGHT, translation: [0, 0, -1] as Vec3 };
  near(seen(STRAIGHT, ahead, 59, 49, 0.25), [62, 52, 1 / 3]);
});

test("a camera at (1, 0, 2) that looks to the left sees what lies ahead of the other on its right", () => {
  // Its z is −x of the scene, its x is z of the scene: the point (0, 0, 4) is at x = 2, z = 1.
  const turned = {
    ...STRAIGHT,
    rotation: [0, 0, 1, 0, 1, 0, -1, 0, 0],
    translation: [-2, 0, 1] as Vec3,
  };
  near(position(turned), [1, 0, 2]);
  near(seen(STRAIGHT, turned, 50, 40, 0.25), [250, 40, 1]);
});

test("a moved camera stands to the right and down in its own axes", () => {
  near(position(movedCamera(STRAIGHT, 0.5, 0.25)), [0.5, 0.25, 0]);
});

test("between two cameras it turns evenly", () => {
  const [c, s] = [Math.cos(0.6), Math.sin(0.6)];
  const turned = { ...STRAIGHT, rotation: [c, 0, -s, 0, 1, 0, s, 0, c] };
  const half = cameraBetween(STRAIGHT, turned, 0.5);
  near(half.rotation, [Math.cos(0.3), 0, -Math.sin(0.3), 0, 1, 0, Math.sin(0.3), 0, Math.cos(0.3)]);
});

test("parallel views shift by (ŝ − s) d", () => {
  const { scene } = makeFixture("3D");
  // docs/conventions.md: d = 1.5 at u = 100, seen from one step to the right at 98.5.
  const transform = transformFor(scene, viewpointOfView(scene, 2), viewpointOfView(scene, 3));
  const u = apply(transform.matrix, [100, 50, 1])[0] + 1.5 * transform.vector[0];
  assert.equal(u, 98.5);
});

test("weights of the nearest views sum to 1 and prefer the nearest", () => {
  const { scene } = makeFixture("3D");
  const found = nearestMaps(scene, viewpointAt(scene, 0.25, 0), 3);
  assert.deepEqual(
    found.map(({ view }) => view),
    [2, 3, 1],
  );
  assert.ok(Math.abs(found.reduce((sum, { weight }) => sum + weight, 0) - 1) < 1e-12);
  assert.ok(found[0]!.weight > found[1]!.weight && found[1]!.weight > found[2]!.weight);
  assert.deepEqual(nearestMaps(scene, viewpointOfView(scene, 1), 3), [{ view: 1, weight: 1 }]);
});
