// SPDX-License-Identifier: BSD-3-Clause

import { colorMap } from "../math/color_maps";
import { nearestMaps, transformFor, viewpointOfView } from "../math/viewpoint";
import type { MapKind } from "../scene/format";
import { isParallel } from "../scene/format";
import type { Side } from "../scene/scene_data";
import type { Session } from "../state/session";
import type { ViewState } from "../state/view_state";
import { overlayStyle } from "./overlay_style";
import type { ComposeInput, Renderer, WarpInput } from "./renderer";
import type { Target } from "./target";

/** How many views are warped to a place between them. */
const WARPED_VIEWS = 3;

/**
 * Draws the state to the canvas and returns what is shown; null where there is nothing to show.
 * Waits for pictures and maps that aren't decoded yet. With a `stride` above 1 one point stands for
 * that many pixels across and down where views are warped.
 */
export async function drawFrame(
  renderer: Renderer,
  session: Session,
  state: ViewState,
  stride = 1,
): Promise<Target | null> {
  const target = await drawTarget(renderer, session, state, stride);
  if (target !== null) renderer.present(target);
  return target;
}

async function drawTarget(
  renderer: Renderer,
  session: Session,
  state: ViewState,
  stride: number,
): Promise<Target | null> {
  const { scene } = session;
  const { viewpoint } = state;
  const { width, height, image } = scene.views[viewpoint.view]!;
  const composeNearest = () => composeView(renderer, session, state, viewpoint.view);
  if (state.refocusOn) {
    const sums = await refocus(renderer, session, state);
    const target = renderer.target("refocused", width, height, "color");
    const { view, atView } = viewpoint;
    const maps = atView ? await mapsInput(renderer, session, state, view) : NO_MAPS;
    renderer.compose(target, { picture: sums.color, isSum: true, ...maps });
    return target;
  }
  if (viewpoint.atView && image !== null) return composeNearest();
  const sources = nearestMaps(scene, viewpoint, stride > 1 ? 2 : WARPED_VIEWS);
  // Without maps nothing can be warped: the nearest picture stands for what is between.
  if (sources.length === 0) return image === null ? null : composeNearest();
  const inputs: WarpInput[] = [];
  for (const { view, weight } of sources) {
    const composed = await composeView(renderer, session, state, view);
    inputs.push({
      colors: composed.color,
      value: await codesTexture(renderer, session, view, "value", "own"),
      width: composed.width,
      height: composed.height,
      transform: transformFor(scene, viewpointOfView(scene, view), viewpoint),
      weight,
    });
  }
  const coarse = [width, height].map((length) => Math.ceil(length / stride));
  const target = renderer.target("combined", coarse[0]!, coarse[1]!, "color");
  renderer.warp(target, inputs, scene.value, isParallel(scene), stride, [width, height]);
  return target;
}

/** The mean of what all views within the aperture see at the focus, as sums with their count. */
export async function refocus(
  renderer: Renderer,
  session: Session,
  state: ViewState,
): Promise<Target> {
  const { scene, data } = session;
  const { viewpoint, aperture, focus } = state;
  const { width, height } = scene.views[viewpoint.view]!;
  const views = scene.views.flatMap((view, idx) => {
    const away = Math.hypot(view.s - viewpoint.s, view.t - viewpoint.t);
    return view.image !== null && away <= aperture ? [idx] : [];
  });
  const pictures = await Promise.all(views.map((view) => data.picture(view)));
  const target = renderer.target("sums", width, height, "sums");
  target.clear();
  views.forEach((view, idx) => {
    const picture = pictures[idx]!;
    renderer.addRefocused(
      target,
      renderer.textures.light(String(view), picture),
      [picture.width, picture.height],
      transformFor(scene, viewpoint, viewpointOfView(scene, view)),
      focus,
    );
  });
  return target;
}

/** A view's picture with overlay, interval and wipe; what is drawn already is taken as it is. */
async function composeView(
  renderer: Renderer,
  session: Session,
  state: ViewState,
  view: number,
): Promise<Target> {
  const { width, height } = session.scene.views[view]!;
  const { overlay, opacity, intervalOn, interval, wipeOn, wipe } = state;
  const key = JSON.stringify([
    view,
    overlay === "none" ? null : [overlay, opacity],
    intervalOn ? interval : null,
    wipeOn ? wipe : null,
  ]);
  const bitmap = await session.data.picture(view);
  const maps = await mapsInput(renderer, session, state, view);
  const { target, isDrawn } = renderer.composed(key, width, height);
  if (isDrawn) return target;
  const picture = renderer.textures.picture(String(view), bitmap);
  renderer.compose(target, { picture, isSum: false, ...maps });
  return target;
}

type MapsInput = Omit<ComposeInput, "picture" | "isSum">;

const NO_MAPS: MapsInput = {
  value: null,
  otherValue: null,
  overlay: null,
  interval: null,
  divider: 1e9,
};

async function mapsInput(
  renderer: Renderer,
  session: Session,
  state: ViewState,
  view: number,
): Promise<MapsInput> {
  const { data, scene } = session;
  const codes = (kind: MapKind, side: Side) => codesTexture(renderer, session, view, kind, side);
  const wiped = state.wipeOn && data.hasMap(view, "value", "other");
  const { overlay } = state;
  const input: MapsInput = { ...NO_MAPS };
  if (!data.hasMap(view, "value")) return input;
  if (wiped) input.divider = state.wipe * scene.views[view]!.width;
  if (state.intervalOn) {
    input.interval = state.interval;
    input.value = await codes("value", "own");
    if (wiped) input.otherValue = await codes("value", "other");
  }
  if (overlay !== "none" && data.hasMap(view, overlay)) {
    const style = overlayStyle(session, overlay);
    const hasOther = wiped && data.hasMap(view, overlay, "other");
    input.overlay = {
      codes: await codes(overlay, "own"),
      otherCodes: hasOther ? await codes(overlay, "other") : null,
      colorMap: renderer.textures.row(`map ${style.colors}`, colorMap(style.colors)),
      range: style.codes,
      none: style.none,
      opacity: state.opacity,
    };
  }
  return input;
}

/** The texture of a map. */
export async function codesTexture(
  renderer: Renderer,
  session: Session,
  view: number,
  kind: MapKind,
  side: Side,
): Promise<WebGLTexture> {
  const { width, height } = session.scene.views[view]!;
  const codes = await session.data.map(view, kind, side);
  return renderer.textures.codes(`${side} ${kind} ${view}`, codes, width, height);
}
