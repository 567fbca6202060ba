// SPDX-License-Identifier: BSD-3-Clause

import {
  AmbientLight,
  DirectionalLight,
  Group,
  type Object3D,
  Points,
  PointsMaterial,
} from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { PLYLoader } from "three/addons/loaders/PLYLoader.js";
import { SceneError } from "../scene/scene_error";

/** A point cloud in the scene's axes. Throws SceneError. */
export function readCloud(bytes: Uint8Array<ArrayBuffer>, name: string): Object3D {
  try {
    const geometry = new PLYLoader().parse(bytes.buffer);
    const colored = geometry.hasAttribute("color");
    if (!geometry.hasAttribute("position")) throw new Error("no points");
    const material = new PointsMaterial({
      size: 2,
      sizeAttenuation: false,
      vertexColors: colored,
      color: colored ? 0xffffff : 0xb8bcc0,
    });
    return new Points(geometry, material);
  } catch {
    throw new SceneError(`Damaged scene: ${name} is not a point cloud in binary PLY.`);
  }
}

/** A surface in the axes of glTF: y up, z back. Throws SceneError. */
export async function readMesh(bytes: Uint8Array<ArrayBuffer>, name: string): Promise<Object3D> {
  try {
    const { scene } = await new GLTFLoader().parseAsync(bytes.buffer, "");
    const group = new Group();
    const sun = new DirectionalLight(0xffffff, 1.5);
    sun.position.set(0.3, 0.6, 1);
    group.add(scene, new AmbientLight(0xffffff, 1.5), sun);
    return group;
  } catch {
    throw new SceneError(`Damaged scene: ${name} is not a surface in binary glTF.`);
  }
}
