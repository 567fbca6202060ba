// SPDX-License-Identifier: BSD-3-Clause

import { codeOfValue, valueOfCode } from "../math/codes";
import type { ColorMapName } from "../math/color_maps";
import type { MapKind } from "../scene/format";
import type { Session } from "../state/session";

/** How the codes of a kind of map become colours. */
export interface OverlayStyle {
  label: string;
  unit: string;
  colors: ColorMapName;
  /** Codes at the first and the last entry of the colour map. */
  codes: [number, number];
  /** What those codes mean. */
  ends: [number, number];
  /** Code of pixels without an estimate. */
  none: number;
}

export function overlayStyle(session: Session, kind: MapKind): OverlayStyle {
  const { scene, usual } = session;
  switch (kind) {
    case "value":
      return {
        label: scene.value.name,
        unit: scene.value.unit,
        colors: "turbo",
        codes: usual,
        ends: [valueOfCode(usual[0], scene.value), valueOfCode(usual[1], scene.value)],
        none: 0,
      };
    case "confidence":
      // Every byte is a confidence; pixels without an estimate have 0.
      return {
        label: "confidence",
        unit: "",
        colors: "viridis",
        codes: [0, 255],
        ends: [0, 1],
        none: 256,
      };
    case "level":
      return {
        label: "pyramid level",
        unit: "",
        colors: "levels",
        codes: [0, 255],
        ends: [0, 7],
        none: 255,
      };
    case "error": {
      const range = scene.error!;
      const end = Math.max(Math.abs(range.min), Math.abs(range.max));
      return {
        label: "error",
        unit: scene.value.unit,
        colors: "signed",
        codes: [codeOfValue(-end, range), codeOfValue(end, range)],
        ends: [-end, end],
        none: 0,
      };
    }
  }
}
