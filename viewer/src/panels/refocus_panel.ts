// SPDX-License-Identifier: BSD-3-Clause

import { valueOfCode } from "../math/codes";
import { depthOfValue, formatDepth, formatNumber } from "../math/scene_depth";
import { pixelValues } from "../state/pixel_values";
import type { Session } from "../state/session";
import { checkbox, el, panel, slider } from "./dom";

/** Focus and aperture of a lens as wide as the light field. */
export function refocusPanel(session: Session): HTMLElement | null {
  const { scene, store, usual } = session;
  const pictures = scene.views.filter((view) => view.image !== null);
  if (pictures.length < 2) return null;
  const on = checkbox("refocus", (refocusOn) => store.set({ refocusOn }));
  const [low, high] = usual.map((code) => valueOfCode(code, scene.value)) as [number, number];
  const margin = 0.15 * (high - low);
  const focus = slider({
    label: "focus",
    min: low - margin,
    max: high + margin,
    step: (high - low) / 500,
    format: (value) => {
      const depth =
        scene.depth === null ? "" : ` · ${formatDepth(depthOfValue(value, scene), scene)}`;
      return `${formatNumber(value, 3)}${depth}`;
    },
    onInput: (value) => store.set({ refocusOn: true, focus: value }),
  });
  const widest = Math.max(
    ...pictures.map((a) => Math.hypot(a.s - pictures[0]!.s, a.t - pictures[0]!.t)),
  );
  const aperture = slider({
    label: "aperture radius",
    min: 0,
    max: Math.ceil(10 * widest) / 10,
    step: 0.1,
    format: (value) => `${formatNumber(value, 3)} steps`,
    onInput: (value) => store.set({ refocusOn: true, aperture: value }),
  });
  const pick = el("button", { type: "button" }, "Focus on the picked pixel");
  pick.addEventListener("click", async () => {
    const { picked } = store.get();
    if (picked === null) return;
    try {
      const values = await pixelValues(session, picked);
      if (values?.value != null) store.set({ refocusOn: true, focus: values.value });
    } catch (reason) {
      session.report(reason);
    }
  });
  store.watch(["refocusOn", "focus", "aperture", "picked"], (state) => {
    on.input.checked = state.refocusOn;
    focus.set(state.focus);
    aperture.set(state.aperture);
    pick.disabled = state.picked === null;
  });
  return panel(
    "Refocus",
    on.element,
    focus.element,
    aperture.element,
    el("div", { class: "row" }, pick),
  );
}
