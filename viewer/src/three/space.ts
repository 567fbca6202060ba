// SPDX-License-Identifier: BSD-3-Clause

import {
  Box3,
  Group,
  type Object3D,
  PerspectiveCamera,
  Scene as Space3,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { position, type Vec3 } from "../math/camera";
import type { ViewEntry } from "../scene/format";

/** The 3D space with an eye that orbits. Its y is up and z back, as three has it. */
export class Space {
  /** What is in the scene's axes: x right, y down, z ahead. */
  readonly inScene = new Group();
  readonly eye = new PerspectiveCamera(45, 1, 1e-3, 1e4);
  private readonly space = new Space3();
  private readonly renderer: WebGLRenderer;
  private readonly controls: OrbitControls;
  private wanted = false;

  /** The eye stands where `view` was taken, looking at `depth` (scene units) ahead. */
  constructor(
    readonly canvas: HTMLCanvasElement,
    view: ViewEntry,
    depth: number,
    private readonly beforeDraw: () => void,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: false });
    this.renderer.setClearColor(0x0e0f10);
    this.inScene.rotation.x = Math.PI;
    this.space.add(this.inScene);
    this.eye.up.copy(upOf(view));
    // The controls keep the eye's up of the moment they are made.
    this.controls = new OrbitControls(this.eye, canvas);
    this.standAt(view, depth);
    this.controls.addEventListener("change", () => this.redraw());
    canvas.addEventListener("keydown", (event) => this.onKey(event));
    canvas.addEventListener("webglcontextrestored", () => this.redraw());
    new ResizeObserver(() => this.redraw()).observe(canvas);
  }

  /** Adds to the axes of glTF. */
  addUpright(object: Object3D): void {
    this.space.add(object);
    this.redraw();
  }

  remove(object: Object3D): void {
    object.removeFromParent();
    this.redraw();
  }

  /** Stands where a view was taken, looking at `depth` (scene units) ahead. */
  standAt(view: ViewEntry, depth: number): void {
    const { camera, height } = view;
    const [x, y, z] = position(camera);
    const ahead: Vec3 = [camera.rotation[6]!, camera.rotation[7]!, camera.rotation[8]!];
    this.eye.fov = (2 * Math.atan(height / 2 / camera.focal[1]) * 180) / Math.PI;
    this.eye.near = depth / 200;
    this.eye.far = depth * 200;
    this.eye.position.set(x, -y, -z);
    this.controls.target.set(x + depth * ahead[0], -y - depth * ahead[1], -z - depth * ahead[2]);
    this.controls.update();
    this.redraw();
  }

  /** Looks at an object that lies somewhere else than what the eye looks at now. */
  bringIntoView(object: Object3D): void {
    object.updateWorldMatrix(true, true);
    const box = new Box3().setFromObject(object);
    if (box.isEmpty()) return;
    const size = box.getSize(new Vector3()).length();
    const near = box.clone().expandByScalar(size / 2);
    if (near.containsPoint(this.controls.target)) return;
    const middle = box.getCenter(new Vector3());
    this.eye.near = size / 1000;
    this.eye.far = size * 100;
    this.controls.target.copy(middle);
    this.eye.position.copy(middle).add(new Vector3(0, 0, 1.2 * size));
    this.controls.update();
    this.redraw();
  }

  /** Focal length of the eye, px of the canvas. */
  focalPx(): number {
    return this.canvas.height / 2 / Math.tan((this.eye.fov * Math.PI) / 360);
  }

  redraw(): void {
    if (this.wanted) return;
    this.wanted = true;
    requestAnimationFrame(() => {
      this.wanted = false;
      this.draw();
    });
  }

  private draw(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.setSize(width, height, false);
    this.eye.aspect = width / height;
    this.eye.updateProjectionMatrix();
    this.beforeDraw();
    this.renderer.render(this.space, this.eye);
  }

  /** Arrow keys orbit, plus and minus go nearer and back. */
  private onKey(event: KeyboardEvent): void {
    const turns: Record<string, [number, number]> = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, -1],
      ArrowDown: [0, 1],
    };
    const { eye, controls } = this;
    const away = eye.position.clone().sub(controls.target);
    const turn = turns[event.key];
    if (turn !== undefined) {
      const right = new Vector3().crossVectors(eye.up, away).normalize();
      away.applyAxisAngle(eye.up.clone().normalize(), 0.08 * turn[0]);
      away.applyAxisAngle(right, 0.08 * turn[1]);
    } else if (event.key === "+" || event.key === "=") away.multiplyScalar(0.9);
    else if (event.key === "-") away.multiplyScalar(1 / 0.9);
    else return;
    event.preventDefault();
    eye.position.copy(controls.target).add(away);
    controls.update();
    this.redraw();
  }
}

/** Up of a view in the axes of three. */
function upOf(view: ViewEntry): Vector3 {
  const { rotation } = view.camera;
  return new Vector3(-rotation[3]!, rotation[4]!, rotation[5]!);
}
