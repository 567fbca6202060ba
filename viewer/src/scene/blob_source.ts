// SPDX-License-Identifier: BSD-3-Clause

import { oneLine, SceneError } from "./scene_error";

/** Where the description of a scene and its named blobs come from. */
export interface BlobSource {
  /** The text of the scene file. */
  description(): Promise<string>;
  /** The bytes of a blob. Throws SceneError where there is none of the name. */
  bytes(name: string): Promise<Uint8Array<ArrayBuffer>>;
  /** The first of the names that surely has no blob; null where that isn't known beforehand. */
  firstMissing(names: string[]): string | null;
}

/** Blobs that stand in the page itself: the one file that opens from file://, where fetch is refused. */
export class PageSource implements BlobSource {
  private readonly elements = new Map<string, Element>();

  constructor(
    page: Document,
    private readonly scene: Element,
  ) {
    for (const element of page.querySelectorAll("script.gigaray-blob")) {
      this.elements.set(element.getAttribute("data-name") ?? "", element);
    }
  }

  /** The source of a page that carries a scene; null where it carries none. */
  static find(page: Document): PageSource | null {
    const scene = page.getElementById("gigaray-scene");
    return scene === null ? null : new PageSource(page, scene);
  }

  async description(): Promise<string> {
    return this.scene.textContent ?? "";
  }

  async bytes(name: string): Promise<Uint8Array<ArrayBuffer>> {
    const element = this.elements.get(name);
    if (element === undefined) throw new SceneError(`Damaged scene: ${name} is missing.`);
    try {
      const text = atob((element.textContent ?? "").trim());
      const bytes = new Uint8Array(text.length);
      for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
      return bytes;
    } catch {
      throw new SceneError(`Damaged scene: ${name} is not base64.`);
    }
  }

  firstMissing(names: string[]): string | null {
    return names.find((name) => !this.elements.has(name)) ?? null;
  }
}

/** Files beside the page: a folder on a static host, or the server of `gigaray view`. */
export class FolderSource implements BlobSource {
  async description(): Promise<string> {
    return new TextDecoder().decode(await this.get("scene.json"));
  }

  bytes(name: string): Promise<Uint8Array<ArrayBuffer>> {
    return this.get(`data/${name.split("/").map(encodeURIComponent).join("/")}`);
  }

  firstMissing(): string | null {
    return null;
  }

  private async get(path: string): Promise<Uint8Array<ArrayBuffer>> {
    let answer: Response;
    try {
      answer = await fetch(path);
    } catch (reason) {
      const hint = location.protocol === "file:" ? " A folder opens from a web server alone." : "";
      // Not damage: the server may be back in a moment.
      throw new Error(`Cannot read ${path}: ${oneLine(reason)}.${hint}`);
    }
    if (answer.ok) return new Uint8Array(await answer.arrayBuffer());
    throw new SceneError(
      answer.status === 404
        ? `Damaged scene: ${path} is missing.`
        : `Cannot read ${path}: ${answer.status} ${answer.statusText}.`,
    );
  }
}
