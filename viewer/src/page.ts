// SPDX-License-Identifier: BSD-3-Clause

import { Stage } from './gl/stage';
import { comparePanel } from './panels/compare_panel';
import { el } from './panels/dom';
import { intervalPanel } from './panels/interval_panel';
import { overlayPanel } from './panels/overlay_panel';
import { PicturePanel, pictureHint } from './panels/picture_panel';
import { pixelPanel } from './panels/pixel_panel';
import { refocusPanel } from './panels/refocus_panel';
import { viewPanel } from './panels/view_panel';
import type { SceneData } from './scene/scene_data';
import { SceneError } from './scene/scene_error';
import { Moves } from './state/moves';
import type { Session } from './state/session';
import { usualCodes } from './state/value_range';
import { createStore } from './state/view_state';

export interface Page {
  element: HTMLElement;
  session: Session;
  stage: Stage;
  picture: PicturePanel;
  moves: Moves;
}

/** Makes the panels of a scene. Throws SceneError where the first view cannot be shown. */
export async function buildPage(data: SceneData): Promise<Page> {
  const { scene } = data;
  const line = el('p', { class: 'report', role: 'status' });
  const session: Session = {
    data,
    scene,
    store: createStore(scene),
    usual: await usualOfScene(data),
    report: (text) => {
      line.textContent = text ?? '';
    },
  };
  const top = scene.views[scene.top_view]!;
  if (top.image !== null) await data.picture(scene.top_view);
  const stage = Stage.create(el('canvas'), session);
  if (stage === null) {
    throw new SceneError('This browser has no WebGL2, which this page draws with.');
  }
  const moves = new Moves(session);
  const picture = new PicturePanel(stage.canvas, session, moves);
  const facts = `${scene.kind}, ${scene.views.length} views, ${top.width} × ${top.height} px`;
  const element = el(
    'div',
    { class: 'page' },
    el('header', {}, el('h1', {}, scene.title), el('span', { class: 'quiet' }, facts)),
    el(
      'main',
      {},
      el('div', { class: 'stage' }, picture.element),
      el('div', { class: 'below' }, line, el('p', { class: 'quiet hint' }, pictureHint(session))),
    ),
    el(
      'aside',
      { 'aria-label': 'Controls' },
      ...[
        viewPanel(session, moves),
        pixelPanel(session, picture),
        overlayPanel(session),
        intervalPanel(session),
        refocusPanel(session),
        comparePanel(session),
      ].filter((part) => part !== null),
    ),
  );
  stage.redraw();
  return { element, session, stage, picture, moves };
}

/** The codes that the values of the first view with a map lie between. */
async function usualOfScene(data: SceneData): Promise<[number, number]> {
  const { scene } = data;
  const order = [scene.top_view, ...scene.views.keys()];
  const view = order.find((idx) => data.hasMap(idx, 'value'));
  return view === undefined ? [1, 65535] : usualCodes(await data.map(view, 'value'));
}
