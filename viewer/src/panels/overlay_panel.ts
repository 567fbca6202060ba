// SPDX-License-Identifier: BSD-3-Clause

import { overlayStyle } from "../gl/overlay_style";
import { colorMap, cssGradient } from "../math/color_maps";
import { depthOfValue, formatDepth, formatNumber } from "../math/scene_depth";
import { MAP_KINDS, type MapKind } from "../scene/format";
import type { Session } from "../state/session";
import { choice, el, panel, slider } from "./dom";

/** Chooses the map over the picture, and says what its colours mean. */
export function overlayPanel(session: Session): HTMLElement | null {
  const { scene, store } = session;
  const kinds = MAP_KINDS.filter((kind) => scene.views.some((view) => view.maps?.[kind]));
  if (kinds.length === 0) return null;
  const label = (kind: MapKind) => (kind === "value" ? scene.value.name : kind);
  const kind = choice<MapKind | "none">(
    "Overlay",
    [{ value: "none", label: "none" }, ...kinds.map((value) => ({ value, label: label(value) }))],
    (overlay) => store.set({ overlay }),
  );
  const opacity = slider({
    label: "opacity",
    min: 0,
    max: 1,
    step: 0.01,
    format: (value) => `${Math.round(100 * value)} %`,
    onInput: (value) => store.set({ opacity: value }),
  });
  const legend = el("div", { class: "legend" });
  store.watch(["overlay", "opacity"], (state) => {
    kind.set(state.overlay);
    opacity.set(state.opacity);
    opacity.input.disabled = state.overlay === "none";
    legend.hidden = state.overlay === "none";
    if (state.overlay !== "none") legend.replaceChildren(...legendOf(session, state.overlay));
  });
  return panel("Overlay", kind.element, opacity.element, legend);
}

function legendOf(session: Session, kind: MapKind): HTMLDivElement[] {
  const { scene } = session;
  const style = overlayStyle(session, kind);
  const rgba = colorMap(style.colors);
  if (kind === "level") {
    const swatches = [0, 1, 2, 3, 4, 5, 6, 7].map((level) => {
      const swatch = el("span", { class: "swatch" }, String(level));
      swatch.style.background = `rgb(${rgba.slice(4 * level, 4 * level + 3).join(" ")})`;
      return swatch;
    });
    return [el("div", { class: "swatches" }, ...swatches), quiet("pyramid level; 0 is the finest")];
  }
  const bar = el("div", { class: "bar" });
  bar.style.background = cssGradient(rgba);
  const [low, high] = style.ends;
  const ticks = [low, (low + high) / 2, high];
  const lines = [
    bar,
    el("div", { class: "ticks" }, ...ticks.map((tick) => el("span", {}, formatNumber(tick, 3)))),
  ];
  if (kind === "value" && scene.depth !== null) {
    const depths = ticks.map((tick) =>
      el("span", {}, formatDepth(depthOfValue(tick, scene), scene)),
    );
    lines.push(el("div", { class: "ticks" }, ...depths));
  }
  const meaning =
    kind === "confidence"
      ? (scene.confidence?.meaning ?? "confidence")
      : legendText(kind, style.unit);
  lines.push(quiet(meaning));
  return lines;
}

function legendText(kind: MapKind, unit: string): string {
  return kind === "error" ? `${unit}, estimate minus truth` : `${unit}, nearer to the right`;
}

function quiet(text: string): HTMLDivElement {
  return el("div", { class: "quiet" }, text);
}
