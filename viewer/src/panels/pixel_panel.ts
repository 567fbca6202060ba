// SPDX-License-Identifier: BSD-3-Clause

import { formatDepth, formatNumber, shownPixel } from "../math/scene_depth";
import { type PixelValues, pixelValues } from "../state/pixel_values";
import type { Session } from "../state/session";
import type { PixelOfView } from "../state/view_state";
import { el, numberField, panel } from "./dom";
import type { PicturePanel } from "./picture_panel";

/** What the maps hold under the cursor, or at the picked pixel while there is no cursor. */
export function pixelPanel(session: Session, picture: PicturePanel): HTMLElement {
  const { scene, store } = session;
  const list = el("dl", { class: "values", "aria-live": "polite" });
  let wanted = 0;
  const render = async (pixel: PixelOfView | null) => {
    const number = ++wanted;
    const values = pixel === null ? null : await pixelValues(session, pixel);
    if (number !== wanted) return;
    list.replaceChildren(
      ...describe(session, pixel, values).flatMap(([name, value]) => [
        el("dt", {}, name),
        el("dd", {}, value),
      ]),
    );
  };
  store.watch(["hovered", "picked", "viewpoint"], ({ hovered, picked }) => {
    void render(hovered ?? picked).catch((reason) => session.report(reason));
  });
  const fields = (["u", "v"] as const).map((axis) =>
    numberField(axis, { step: "1", min: "0" }, (value) => {
      const { picked, viewpoint } = store.get();
      const { width, height } = scene.views[viewpoint.view]!;
      const from = picked ?? { u: width / 2, v: height / 2 };
      const shown = shownPixel(value, scene.scale);
      const pixel = { u: from.u, v: from.v, [axis]: shown, view: viewpoint.view };
      void picture.pick(pixel).catch((reason) => session.report(reason));
    }),
  );
  store.watch(["picked"], ({ picked }) => {
    fields.forEach(({ input }, idx) => {
      const shown = idx === 0 ? picked?.u : picked?.v;
      input.value =
        shown === undefined ? "" : String(Math.round((shown + 0.5) / scene.scale - 0.5));
    });
  });
  return panel(
    "Pixel",
    list,
    el(
      "div",
      { class: "row" },
      el("span", { class: "quiet" }, "picked"),
      ...fields.map((f) => f.element),
    ),
  );
}

function describe(
  session: Session,
  pixel: PixelOfView | null,
  values: PixelValues | null,
): [string, string][] {
  const { scene } = session;
  const none = "–";
  const { unit } = scene.value;
  const lines: [string, string][] = [
    ["at", pixel === null ? none : place(session, pixel)],
    [scene.value.name, values?.value == null ? none : `${formatNumber(values.value, 4)} ${unit}`],
  ];
  if (scene.depth !== null) lines.push(["depth", formatDepth(values?.depth ?? null, scene)]);
  const has = (kind: "confidence" | "level" | "error") =>
    scene.views.some((view) => view.maps?.[kind] !== undefined);
  const number = (value: number | null | undefined, digits: number) =>
    value == null ? none : formatNumber(value, digits);
  if (has("confidence")) lines.push(["confidence", number(values?.confidence, 3)]);
  if (has("level")) lines.push(["level", number(values?.level, 3)]);
  if (has("error")) lines.push(["error", number(values?.error, 3)]);
  return lines;
}

function place(session: Session, pixel: PixelOfView): string {
  const { scene } = session;
  const full = (shown: number) => formatNumber((shown + 0.5) / scene.scale - 0.5, 5);
  return `${scene.views[pixel.view]!.name}  ${full(pixel.u)}, ${full(pixel.v)} px`;
}
