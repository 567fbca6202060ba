// SPDX-License-Identifier: BSD-3-Clause

import { MAX_CODE, valueOfCode } from "../math/codes";
import type { Interval } from "../math/interval";
import { type Viewpoint, viewpointOfView } from "../math/viewpoint";
import type { MapKind, Scene } from "../scene/format";
import { Store } from "./store";

/** A pixel of a view, px shown. */
export interface PixelOfView {
  view: number;
  u: number;
  v: number;
}

/** All that the page shows. Fields are replaced, never changed in place. */
export interface ViewState {
  viewpoint: Viewpoint;
  stage: "picture" | "3D";
  overlay: MapKind | "none";
  /** 0 … 1 */
  opacity: number;
  intervalOn: boolean;
  interval: Interval;
  /** Half the interval that a click makes, in the unit of values. */
  delta: number;
  /** What a click on the picture does besides picking the pixel. */
  click: "pick" | "mask";
  refocusOn: boolean;
  /** Value that is in focus. */
  focus: number;
  /** View steps. */
  aperture: number;
  picked: PixelOfView | null;
  hovered: PixelOfView | null;
  wipeOn: boolean;
  /** 0 … 1 of the picture's width */
  wipe: number;
  /** Points of less confidence (0 … 1) aren't drawn in 3D. */
  pointConfidence: number;
  /** Whether 3D shows the present view's points, those of all views, the cloud or the mesh. */
  points: "view" | "all" | "cloud" | "mesh";
}

export type ViewStore = Store<ViewState>;

/** What the page shows first. `usual` are the codes that most values lie between. */
function initialState(scene: Scene, usual: [number, number]): ViewState {
  const [low, high] = usual.map((code) => valueOfCode(code, scene.value)) as [number, number];
  const hasMaps = scene.views.some((view) => view.maps !== null);
  return {
    viewpoint: viewpointOfView(scene, scene.top_view),
    stage: "picture",
    overlay: "none",
    opacity: 0.85,
    intervalOn: false,
    interval: { near: MAX_CODE, far: 1 },
    delta: Number(((high - low) / 20).toPrecision(2)),
    click: "pick",
    refocusOn: false,
    focus: (low + high) / 2,
    aperture: 1.5,
    picked: null,
    hovered: null,
    wipeOn: false,
    wipe: 0.5,
    pointConfidence: 0.5,
    points: hasMaps ? "view" : scene.cloud !== null ? "cloud" : "mesh",
  };
}

export function createStore(scene: Scene, usual: [number, number]): ViewStore {
  return new Store(initialState(scene, usual));
}
