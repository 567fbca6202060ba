// SPDX-License-Identifier: BSD-3-Clause

import { MAX_CODE, valueOfCode } from "../math/codes";
import { segmentLine } from "../math/interval";
import { depthOfValue, formatDepth, formatNumber } from "../math/scene_depth";
import type { Session } from "../state/session";
import { sliderCodes } from "../state/value_range";
import { checkbox, el, numberField, panel, slider } from "./dom";

/** The depth interval, its mask, and the line that makes the masks of all views. */
export function intervalPanel(session: Session): HTMLElement | null {
  const { scene, store, usual } = session;
  if (!scene.views.some((view) => view.maps !== null)) return null;
  const words = (code: number) => {
    if (code === MAX_CODE) return "all that is nearer";
    if (code === 1) return "all that is farther";
    const value = valueOfCode(code, scene.value);
    const depth =
      scene.depth === null ? "" : ` · ${formatDepth(depthOfValue(value, scene), scene)}`;
    return formatNumber(value, 4) + depth;
  };
  const show = checkbox("mask over the picture", (intervalOn) => store.set({ intervalOn }));
  const { far: min, near: max } = sliderCodes(usual);
  // A slider at its end takes what lies beyond along: outliers belong to the whole, too.
  const beyond = (code: number) => (code >= max ? MAX_CODE : code <= min ? 1 : code);
  const end = (label: "near" | "far", set: (code: number) => void) =>
    slider({
      label,
      min,
      max,
      step: 1,
      format: () => words(store.get().interval[label]),
      onInput: (code) => set(beyond(code)),
    });
  // An end that is pushed past the other one takes it along.
  const near = end("near", (code) => {
    const { interval } = store.get();
    store.set({ intervalOn: true, interval: { near: code, far: Math.min(interval.far, code) } });
  });
  const far = end("far", (code) => {
    const { interval } = store.get();
    store.set({ intervalOn: true, interval: { near: Math.max(interval.near, code), far: code } });
  });
  const track = el("div", { class: "span", "aria-hidden": "true" }, el("div"));
  const clicks = checkbox("a click takes the depth of its pixel", (on) =>
    store.set({ click: on ? "mask" : "pick" }),
  );
  const delta = numberField(
    "±",
    { min: "0", step: "any", "aria-label": "half the interval of a click" },
    (value) => store.set({ delta: Math.max(0, value) }),
  );
  const parts: HTMLElement[] = [
    show.element,
    near.element,
    track,
    far.element,
    el("div", { class: "row" }, clicks.element),
    el("div", { class: "row" }, delta.element, el("span", { class: "quiet" }, scene.value.unit)),
  ];
  const line = el("code", { class: "line", tabindex: "0" });
  if (scene.segment !== null) parts.push(el("div", { class: "row copy" }, line, copyButton(line)));
  store.watch(["interval", "intervalOn", "click", "delta"], (state) => {
    const { interval } = state;
    show.input.checked = state.intervalOn;
    clicks.input.checked = state.click === "mask";
    delta.input.value = String(state.delta);
    near.set(interval.near);
    far.set(interval.far);
    const place = (code: number) => 100 * Math.min(1, Math.max(0, (code - min) / (max - min)));
    const bar = track.firstElementChild as HTMLElement;
    bar.style.left = `${place(interval.far)}%`;
    bar.style.right = `${100 - place(interval.near)}%`;
    if (scene.segment !== null) {
      line.textContent = segmentLine(scene.segment.result, interval, scene.value);
    }
  });
  return panel("Depth interval", ...parts);
}

function copyButton(line: HTMLElement): HTMLElement {
  const button = el("button", { type: "button" }, "Copy");
  button.addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(line.textContent ?? "");
      button.textContent = "Copied";
    } catch {
      // Pages of file:// may have no clipboard: the selected text is one key away from it.
      getSelection()?.selectAllChildren(line);
      button.textContent = "Ctrl+C";
    }
    setTimeout(() => {
      button.textContent = "Copy";
    }, 1500);
  });
  return button;
}
