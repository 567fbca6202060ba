// SPDX-License-Identifier: BSD-3-Clause
// 3D: the points of value maps, a point cloud or a surface, seen from anywhere.

import type { BufferGeometry, Object3D, Points, ShaderMaterial } from "three";
import { valueOfCode } from "../math/codes";
import { formatNumber } from "../math/scene_depth";
import { oneLine } from "../scene/scene_error";
import type { Session } from "../state/session";
import type { ViewState } from "../state/view_state";
import { readCloud, readMesh } from "../three/models";
import { Space } from "../three/space";
import { disposePoints, setShown, valuePoints } from "../three/value_points";
import { choice, el, panel, slider } from "./dom";

/** Of all views together no more points are drawn: some views are left out, evenly. */
const MOST_POINTS = 8e6;

/** What the reader can do in 3D, in one line. */
export const POINTS_HINT =
  "drag orbits · right button moves · wheel or + − goes nearer · arrow keys orbit";

type ViewPoints = Points<BufferGeometry, ShaderMaterial>;

export class PointsPanel {
  readonly element = el("div", { class: "points", hidden: "" });
  private space: Space | null = null;
  private views = new Map<number, ViewPoints>();
  private model: Object3D | null = null;
  private wanted = 0;

  constructor(private readonly session: Session) {
    session.store.watch(["stage", "points", "viewpoint"], (state) => {
      this.element.hidden = state.stage !== "3D";
      if (state.stage !== "3D") return;
      this.update(state).catch((reason) => session.report(reason));
    });
    session.store.watch(["pointConfidence", "interval", "intervalOn"], () => this.space?.redraw());
  }

  /** Shows what the state asks for; the eye stays where it is. */
  private async update(state: ViewState): Promise<void> {
    const number = ++this.wanted;
    const space = this.open(state);
    if (state.points === "cloud" || state.points === "mesh") {
      this.keepViews([]);
      const model = await this.readModel(state.points);
      if (number !== this.wanted) return;
      this.dropModel();
      this.model = model;
      if (state.points === "mesh") space.addUpright(model);
      else space.inScene.add(model);
      space.bringIntoView(model);
      space.redraw();
      return;
    }
    this.dropModel();
    const wanted = this.viewsOf(state);
    this.keepViews(wanted);
    for (const view of wanted) {
      if (this.views.has(view)) continue;
      const points = await this.readView(view);
      if (number !== this.wanted) {
        disposePoints(points);
        return;
      }
      this.views.set(view, points);
      space.inScene.add(points);
      space.redraw();
    }
  }

  /** The space is made when it is first seen: it takes a second WebGL context. */
  private open(state: ViewState): Space {
    if (this.space !== null) return this.space;
    const { scene } = this.session;
    const canvas = el("canvas", {
      tabindex: "0",
      role: "application",
      "aria-label": "Points in space. Arrow keys orbit, plus and minus go nearer and back.",
    });
    this.element.append(canvas);
    const view = scene.views[state.viewpoint.view]!;
    try {
      this.space = new Space(canvas, view, this.usualDepth(), () => {
        const { pointConfidence, interval, intervalOn } = this.session.store.get();
        const focalPx = this.space!.focalPx();
        for (const points of this.views.values()) {
          setShown(points, focalPx, pointConfidence, intervalOn ? interval : null);
        }
      });
    } catch (reason) {
      throw new Error(`3D cannot be shown: ${oneLine(reason)}`);
    }
    return this.space;
  }

  /** The eye goes to where the present view was taken. */
  standAtView(): void {
    const { scene, store } = this.session;
    this.space?.standAt(scene.views[store.get().viewpoint.view]!, this.usualDepth());
  }

  /** Of what the views see, scene units of their cameras. */
  private usualDepth(): number {
    const { scene, usual } = this.session;
    const middle = (valueOfCode(usual[0], scene.value) + valueOfCode(usual[1], scene.value)) / 2;
    const inverse = scene.inverse_depth.per_value * middle + scene.inverse_depth.at_zero;
    return inverse > 0 ? 1 / inverse : 1;
  }

  private viewsOf(state: ViewState): number[] {
    const { scene } = this.session;
    const usable = [...scene.views.keys()].filter((view) => {
      const { maps, image } = scene.views[view]!;
      return maps !== null && image !== null;
    });
    const { view } = state.viewpoint;
    if (state.points === "view") return usable.includes(view) ? [view] : usable.slice(0, 1);
    const { width, height } = scene.views[view]!;
    const thin = Math.max(1, Math.ceil((usable.length * width * height) / MOST_POINTS));
    return usable.filter((_, idx) => idx % thin === 0);
  }

  private async readView(view: number): Promise<ViewPoints> {
    const { data, scene } = this.session;
    const picture = await data.picture(view);
    const value = await data.map(view, "value");
    const hasConfidence = data.hasMap(view, "confidence");
    const confidence = hasConfidence ? await data.map(view, "confidence") : null;
    return valuePoints(scene, view, picture, value, confidence);
  }

  private async readModel(kind: "cloud" | "mesh"): Promise<Object3D> {
    const { data, scene } = this.session;
    const { blob } = scene[kind]!;
    const bytes = await data.source.bytes(blob);
    return kind === "cloud" ? readCloud(bytes, blob) : readMesh(bytes, blob);
  }

  private keepViews(kept: number[]): void {
    for (const [view, points] of this.views) {
      if (kept.includes(view)) continue;
      this.space?.remove(points);
      disposePoints(points);
      this.views.delete(view);
    }
  }

  private dropModel(): void {
    if (this.model !== null) this.space?.remove(this.model);
    this.model = null;
  }
}

/** What is shown in 3D. */
export function pointsControls(session: Session, space: PointsPanel): HTMLElement | null {
  const { scene, store } = session;
  const options: { value: ViewState["points"]; label: string }[] = [];
  if (scene.views.some((view) => view.maps !== null)) {
    options.push({ value: "view", label: "this view" }, { value: "all", label: "all views" });
  }
  if (scene.cloud !== null) options.push({ value: "cloud", label: "cloud" });
  if (scene.mesh !== null) options.push({ value: "mesh", label: "surface" });
  if (options.length === 0) return null;
  const what = choice("What 3D shows", options, (points) => store.set({ points, stage: "3D" }));
  const confidence = slider({
    label: "points of confidence from",
    min: 0,
    max: 1,
    step: 0.01,
    format: (value) => formatNumber(value, 2),
    onInput: (pointConfidence) => store.set({ pointConfidence }),
  });
  store.watch(["points", "pointConfidence"], (state) => {
    what.set(state.points);
    confidence.set(state.pointConfidence);
  });
  const hasConfidence = scene.views.some((view) => view.maps?.confidence !== undefined);
  const stand = el("button", { type: "button" }, "Stand at this view");
  stand.addEventListener("click", () => space.standAtView());
  return panel(
    "3D",
    what.element,
    hasConfidence ? confidence.element : null,
    el("div", { class: "row" }, stand),
  );
}
