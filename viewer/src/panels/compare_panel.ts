// SPDX-License-Identifier: BSD-3-Clause

import type { Session } from "../state/session";
import { checkbox, el, panel, slider } from "./dom";

/** The wipe between this result and the other one. */
export function comparePanel(session: Session): HTMLElement | null {
  const { scene, store } = session;
  if (scene.compare === null) return null;
  const on = checkbox("wipe", (wipeOn) => {
    // Without an overlay both sides show the same picture.
    const { overlay } = store.get();
    store.set({ wipeOn, overlay: wipeOn && overlay === "none" ? "value" : overlay });
  });
  const divider = slider({
    label: "divider",
    min: 0,
    max: 1,
    step: 0.005,
    format: (value) => `${Math.round(100 * value)} %`,
    onInput: (wipe) => store.set({ wipe }),
  });
  store.watch(["wipeOn", "wipe"], (state) => {
    on.input.checked = state.wipeOn;
    divider.set(state.wipe);
    divider.input.disabled = !state.wipeOn;
  });
  const sides = el(
    "div",
    { class: "ticks" },
    el("span", {}, `left: ${scene.title}`),
    el("span", {}, `right: ${scene.compare.title}`),
  );
  return panel("Compare", on.element, divider.element, sides);
}
