// SPDX-License-Identifier: BSD-3-Clause

import { formatNumber } from "../math/scene_depth";
import { isParallel } from "../scene/format";
import type { Moves } from "../state/moves";
import type { Session } from "../state/session";
import { el, newId, panel, type Slider, slider } from "./dom";

/** Chooses the view and, of parallel light fields, a place between views. */
export function viewPanel(session: Session, moves: Moves): HTMLElement {
  const { scene, store } = session;
  const id = newId();
  const select = el("select", { id });
  scene.views.forEach((view, idx) => {
    const what = view.maps === null ? " (picture alone)" : "";
    select.append(el("option", { value: String(idx) }, view.name + what));
  });
  select.addEventListener("change", () => moves.toView(Number(select.value)));
  const axes = isParallel(scene) ? (["s", "t"] as const) : [];
  const sliders = axes.flatMap((axis): [typeof axis, Slider][] => {
    const places = scene.views.map((view) => view[axis]);
    const [min, max] = [Math.min(...places), Math.max(...places)];
    if (min === max) return [];
    const made = slider({
      label: axis === "s" ? "s, to the right" : "t, down",
      min,
      max,
      step: "any",
      format: (value) => `${formatNumber(value, 3)} steps`,
      onInput: (value) => {
        const { s, t } = store.get().viewpoint;
        // Near a view the slider holds on to it: the picture itself is shown there.
        const place = places.find((at) => Math.abs(at - value) < 0.03 * Math.min(1, max - min));
        const at = place ?? value;
        moves.toPlace(axis === "s" ? at : s, axis === "t" ? at : t);
      },
    });
    return [[axis, made]];
  });
  store.watch(["viewpoint"], ({ viewpoint }) => {
    select.value = String(viewpoint.view);
    for (const [axis, made] of sliders) made.set(viewpoint[axis]);
  });
  return panel(
    "View",
    el("div", { class: "row" }, el("label", { for: id, class: "hidden" }, "View"), select),
    ...sliders.map(([, made]) => made.element),
  );
}
