// SPDX-License-Identifier: BSD-3-Clause

import { Stage } from "./gl/stage";
import { comparePanel } from "./panels/compare_panel";
import { choice, el } from "./panels/dom";
import { epiPanel } from "./panels/epi_panel";
import { intervalPanel } from "./panels/interval_panel";
import { overlayPanel } from "./panels/overlay_panel";
import { PicturePanel, pictureHint } from "./panels/picture_panel";
import { pixelPanel } from "./panels/pixel_panel";
import { POINTS_HINT, PointsPanel, pointsControls } from "./panels/points_panel";
import { refocusPanel } from "./panels/refocus_panel";
import { samplesPanel } from "./panels/samples_panel";
import { scorePanel } from "./panels/score_panel";
import { viewPanel } from "./panels/view_panel";
import type { SceneData } from "./scene/scene_data";
import { oneLine, SceneError } from "./scene/scene_error";
import { Moves } from "./state/moves";
import type { Session } from "./state/session";
import { usualCodes } from "./state/value_range";
import { createStore } from "./state/view_state";

export interface Page {
  element: HTMLElement;
  session: Session;
  stage: Stage;
  picture: PicturePanel;
  points: PointsPanel;
  moves: Moves;
}

/**
 * Makes the panels of a scene. Throws SceneError where the first view cannot be shown; what is found
 * damaged later goes to `onDamage`.
 */
export async function buildPage(
  data: SceneData,
  onDamage: (reason: SceneError) => void,
): Promise<Page> {
  const { scene } = data;
  const line = el("p", { class: "report", role: "status" });
  const usual = await usualOfScene(data);
  const session: Session = {
    data,
    scene,
    store: createStore(scene, usual),
    usual,
    report: (reason) => {
      if (reason instanceof SceneError) onDamage(reason);
      else line.textContent = reason === null ? "" : oneLine(reason);
    },
  };
  const top = scene.views[scene.top_view]!;
  if (top.image !== null) await data.picture(scene.top_view);
  const stage = Stage.create(el("canvas"), session);
  if (stage === null) {
    throw new SceneError("This browser has no WebGL2, which this page draws with.");
  }
  const moves = new Moves(session);
  const picture = new PicturePanel(stage.canvas, session, moves);
  const points = new PointsPanel(session);
  const hint = el("p", { class: "quiet hint" });
  session.store.watch(["stage"], (state) => {
    picture.element.hidden = state.stage !== "picture";
    hint.textContent = state.stage === "picture" ? pictureHint(session) : POINTS_HINT;
  });
  const facts = `${scene.kind}, ${scene.views.length} views, ${top.width} × ${top.height} px`;
  const element = el(
    "div",
    { class: "page" },
    el(
      "header",
      {},
      el("h1", {}, scene.title),
      el("span", { class: "quiet" }, facts),
      stageTabs(session),
    ),
    el(
      "main",
      {},
      el("div", { class: "stage" }, picture.element, points.element),
      reasonStrip(session),
      el("div", { class: "below" }, line, hint),
    ),
    el("aside", { "aria-label": "Controls" }, ...controls(session, moves, picture, points)),
  );
  stage.redraw();
  return { element, session, stage, picture, points, moves };
}

/** The column of controls; those that concern the picture alone hide while 3D is shown. */
function controls(
  session: Session,
  moves: Moves,
  picture: PicturePanel,
  points: PointsPanel,
): HTMLElement[] {
  const parts: [HTMLElement | null, "picture" | "3D" | "both"][] = [
    [viewPanel(session, moves), "both"],
    [pointsControls(session, points), "3D"],
    [pixelPanel(session, picture), "picture"],
    [overlayPanel(session), "picture"],
    [intervalPanel(session), "both"],
    [refocusPanel(session), "picture"],
    [comparePanel(session), "picture"],
  ];
  return parts.flatMap(([part, where]) => {
    if (part === null) return [];
    session.store.watch(["stage"], ({ stage }) => {
      part.hidden = where !== "both" && where !== stage;
    });
    return [part];
  });
}

/** Chooses between the picture and 3D. */
function stageTabs(session: Session): HTMLElement | null {
  const { views, cloud, mesh } = session.scene;
  if (cloud === null && mesh === null && views.every((view) => view.maps === null)) return null;
  const tabs = choice<"picture" | "3D">(
    "What is shown large",
    [
      { value: "picture", label: "Picture" },
      { value: "3D", label: "3D" },
    ],
    (stage) => session.store.set({ stage }),
  );
  tabs.element.classList.add("tabs");
  session.store.watch(["stage"], ({ stage }) => tabs.set(stage));
  return tabs.element;
}

/** EPI, scores and samples of the picked pixel, below the picture. */
function reasonStrip(session: Session): HTMLElement {
  const close = el("button", { type: "button", "aria-label": "Close the plots" }, "✕");
  close.addEventListener("click", () => session.store.set({ picked: null }));
  const strip = el("section", { class: "reason", "aria-label": "Why this depth" });
  for (const part of [epiPanel(session), scorePanel(session), samplesPanel(session), close]) {
    if (part !== null) strip.append(part);
  }
  session.store.watch(["picked", "stage"], ({ picked, stage }) => {
    strip.hidden = picked === null || stage !== "picture";
  });
  return strip;
}

/** The codes that the values of the first view with a map lie between. */
async function usualOfScene(data: SceneData): Promise<[number, number]> {
  const { scene } = data;
  const order = [scene.top_view, ...scene.views.keys()];
  const view = order.find((idx) => data.hasMap(idx, "value"));
  return view === undefined ? [1, 65535] : usualCodes(await data.map(view, "value"));
}
