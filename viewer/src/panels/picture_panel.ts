// SPDX-License-Identifier: BSD-3-Clause
// The picture: drag and arrow keys move the viewpoint, a click picks a pixel, the wheel enlarges.

import { intervalAround } from "../math/interval";
import { isParallel } from "../scene/format";
import type { Moves } from "../state/moves";
import type { Session } from "../state/session";
import type { PixelOfView } from "../state/view_state";
import { el } from "./dom";

/** A pointer that moves less is a click, px of the screen. */
const CLICK_PX = 4;
const MAX_ZOOM = 32;

const ARROWS: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

export class PicturePanel {
  readonly element: HTMLElement;
  private readonly frame: HTMLElement;
  private readonly marker = el("div", { class: "marker", hidden: "" });
  private readonly divider = el("div", { class: "divider", hidden: "" });
  private zoom = 1;
  /** Middle of what is enlarged, 0 … 1 of the picture. */
  private middle: [number, number] = [0.5, 0.5];

  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly session: Session,
    private readonly moves: Moves,
  ) {
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    canvas.setAttribute(
      "aria-label",
      "Picture. Arrow keys go to the next view, Shift with arrow keys moves the picked pixel, plus and minus enlarge.",
    );
    this.frame = el("div", { class: "frame" }, canvas, this.divider, this.marker);
    this.element = el("div", { class: "picture" }, this.frame);
    new ResizeObserver(() => this.layOut()).observe(this.element);
    this.listen();
    session.store.watch(["viewpoint"], () => this.layOut());
    session.store.watch(["picked", "viewpoint"], () => this.placeMarker());
    session.store.watch(["wipeOn", "wipe"], ({ wipeOn, wipe }) => {
      this.divider.hidden = !wipeOn;
      this.divider.style.left = `${100 * wipe}%`;
    });
  }

  /** Picks a pixel of the present view; in mode `mask` its depth becomes the interval. */
  async pick(pixel: PixelOfView): Promise<void> {
    const { data, scene, store } = this.session;
    const { width, height } = scene.views[pixel.view]!;
    const u = Math.min(width - 1, Math.max(0, Math.round(pixel.u)));
    const v = Math.min(height - 1, Math.max(0, Math.round(pixel.v)));
    store.set({ picked: { view: pixel.view, u, v } });
    const { click, delta } = store.get();
    if (click !== "mask" || !data.hasMap(pixel.view, "value")) return;
    const code = (await data.map(pixel.view, "value"))[v * width + u]!;
    if (code === 0) return;
    store.set({ intervalOn: true, interval: intervalAround(code, delta, scene.value) });
  }

  private listen(): void {
    const { canvas, session } = this;
    const { store } = session;
    let press: { x: number; y: number; from: ReturnType<typeof store.get>["viewpoint"] } | null =
      null;
    let dragged = false;
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      press = { x: event.clientX, y: event.clientY, from: store.get().viewpoint };
      dragged = false;
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (press === null) {
        store.set({ hovered: this.pixelAt(event) });
        return;
      }
      const dx = event.clientX - press.x;
      const dy = event.clientY - press.y;
      if (Math.hypot(dx, dy) >= CLICK_PX) dragged = true;
      if (!dragged) return;
      const shown = canvas.getBoundingClientRect();
      this.moves.drag(press.from, dx / shown.width, dy / shown.width);
    });
    canvas.addEventListener("pointerup", (event) => {
      if (press === null) return;
      press = null;
      if (dragged) this.moves.settle();
      else {
        const pixel = this.pixelAt(event);
        if (pixel !== null) void this.pick(pixel).catch((reason) => this.session.report(reason));
      }
    });
    canvas.addEventListener("pointercancel", () => {
      press = null;
      this.moves.settle();
    });
    canvas.addEventListener("pointerleave", () => store.set({ hovered: null }));
    canvas.addEventListener("keydown", (event) => this.onKey(event));
    canvas.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        this.enlarge(Math.exp(-event.deltaY * 0.0015), event.clientX, event.clientY);
      },
      { passive: false },
    );
    canvas.addEventListener("dblclick", () => this.enlarge(0, 0, 0));
  }

  private onKey(event: KeyboardEvent): void {
    const { scene, store } = this.session;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const arrow = ARROWS[event.key];
    const { viewpoint, picked } = store.get();
    const rect = this.element.getBoundingClientRect();
    const [x, y] = [rect.left + rect.width / 2, rect.top + rect.height / 2];
    if (arrow !== undefined && event.shiftKey) {
      const { width, height } = scene.views[viewpoint.view]!;
      const from = picked ?? { u: width / 2, v: height / 2 };
      const pixel = { view: viewpoint.view, u: from.u + arrow[0], v: from.v + arrow[1] };
      void this.pick(pixel).catch((reason) => this.session.report(reason));
    } else if (arrow !== undefined) this.moves.byKey(...arrow);
    else if (event.key === "Home") this.moves.toView(scene.top_view);
    else if (event.key === "+" || event.key === "=") this.enlarge(1.25, x, y);
    else if (event.key === "-") this.enlarge(0.8, x, y);
    else return;
    event.preventDefault();
  }

  /** The pixel of the present view under the pointer; null between views and outside. */
  private pixelAt(event: MouseEvent): PixelOfView | null {
    const { scene, store } = this.session;
    const { viewpoint } = store.get();
    const { width, height } = scene.views[viewpoint.view]!;
    const rect = this.canvas.getBoundingClientRect();
    const u = Math.floor(((event.clientX - rect.left) / rect.width) * width);
    const v = Math.floor(((event.clientY - rect.top) / rect.height) * height);
    if (!viewpoint.atView || u < 0 || v < 0 || u >= width || v >= height) return null;
    return { view: viewpoint.view, u, v };
  }

  /** By a factor around a place of the screen; 0 shows the whole picture again. */
  private enlarge(factor: number, x: number, y: number): void {
    const before = this.canvas.getBoundingClientRect();
    const at = [(x - before.left) / before.width, (y - before.top) / before.height];
    const zoom = Math.min(MAX_ZOOM, Math.max(1, this.zoom * factor));
    const kept = this.zoom / zoom;
    this.zoom = zoom;
    this.middle = this.middle.map((mid, i) => at[i]! + (mid - at[i]!) * kept) as [number, number];
    this.layOut();
  }

  /** Fits the picture into its place, enlarged where the reader wants it. */
  private layOut(): void {
    const { scene, store } = this.session;
    const { width, height } = scene.views[store.get().viewpoint.view]!;
    const room = this.element.getBoundingClientRect();
    if (room.width === 0 || room.height === 0) return;
    const fit = Math.min(room.width / width, room.height / height) * this.zoom;
    const size = [width * fit, height * fit] as const;
    const rooms = [room.width, room.height] as const;
    const place = size.map((length, i) => {
      if (length <= rooms[i]!) return (rooms[i]! - length) / 2;
      return Math.min(0, Math.max(rooms[i]! - length, rooms[i]! / 2 - this.middle[i]! * length));
    });
    Object.assign(this.frame.style, {
      width: `${size[0]}px`,
      height: `${size[1]}px`,
      left: `${place[0]}px`,
      top: `${place[1]}px`,
    });
    this.canvas.style.imageRendering = fit >= 2 ? "pixelated" : "auto";
  }

  private placeMarker(): void {
    const { scene, store } = this.session;
    const { picked, viewpoint } = store.get();
    const here = picked !== null && viewpoint.atView && picked.view === viewpoint.view;
    this.marker.hidden = !here;
    if (!here) return;
    const { width, height } = scene.views[picked.view]!;
    this.marker.style.left = `${(100 * (picked.u + 0.5)) / width}%`;
    this.marker.style.top = `${(100 * (picked.v + 0.5)) / height}%`;
  }
}

/** What the reader can do here, in one line. */
export function pictureHint(session: Session): string {
  const keys = session.scene.kind === "3D" ? "← →" : "← → ↑ ↓";
  const drag = isParallel(session.scene) ? "drag or" : "drag around,";
  return `${drag} ${keys} moves between views · click picks a pixel · wheel enlarges`;
}
