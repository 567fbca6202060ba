// SPDX-License-Identifier: BSD-3-Clause

import { publishFailure, publishHandle } from "./handle";
import { buildPage } from "./page";
import { FolderSource, PageSource } from "./scene/blob_source";
import { SceneData } from "./scene/scene_data";
import { oneLine, SceneError } from "./scene/scene_error";
import "./style.css";

/** Puts one line in the place of the panels. */
function showFailure(line: string): void {
  const alert = document.createElement("p");
  alert.setAttribute("role", "alert");
  alert.className = "failure";
  alert.textContent = line;
  document.body.replaceChildren(alert);
}

async function start(): Promise<void> {
  if (typeof DecompressionStream === "undefined" || typeof Object.hasOwn === "undefined") {
    throw new SceneError("This browser is too old for this page: it takes one of 2023 or later.");
  }
  const data = await SceneData.open(PageSource.find(document) ?? new FolderSource());
  const page = await buildPage(data, (reason) => showFailure(reason.message));
  document.body.replaceChildren(page.element);
  await page.stage.idle();
  publishHandle(page);
}

const ready = start();
publishFailure(ready);
ready.catch((reason) => {
  showFailure(oneLine(reason));
  if (!(reason instanceof SceneError)) console.error(reason);
});
