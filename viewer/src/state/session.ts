// SPDX-License-Identifier: BSD-3-Clause

import type { Scene } from "../scene/format";
import type { SceneData } from "../scene/scene_data";
import type { ViewStore } from "./view_state";

/** What every panel gets. */
export interface Session {
  data: SceneData;
  scene: Scene;
  store: ViewStore;
  /** Codes of values that colours, sliders and plots span: [far end, near end]. */
  usual: [number, number];
  /**
   * Says in one line what went wrong: a damaged scene takes the place of the page, anything else
   * stands below the picture until null takes it back.
   */
  report: (reason: unknown) => void;
}
