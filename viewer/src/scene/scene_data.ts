// SPDX-License-Identifier: BSD-3-Clause

import { decodeCodes8, decodeCodes16 } from "../math/codes";
import type { BlobSource } from "./blob_source";
import { ByteCache } from "./byte_cache";
import type { MapKind, Scene, ViewEntry } from "./format";
import { gunzip } from "./gunzip";
import { parseScene } from "./parse_scene";
import { SceneError } from "./scene_error";

/** Codes of a map, row major: 16 bits of value and error, 8 bits of confidence and level. */
export type Codes = Uint16Array<ArrayBuffer> | Uint8Array<ArrayBuffer>;

/** Which result a map is of: the scene's own, or the one that it is compared with. */
export type Side = "own" | "other";

/** Decoded pictures and maps of main memory that are kept. */
const KEPT_BYTES = 1 << 30;

/** The scene and its pictures and maps, decoded when they are first asked for. */
export class SceneData {
  private readonly cache = new ByteCache<unknown>(KEPT_BYTES);

  private constructor(
    readonly source: BlobSource,
    readonly scene: Scene,
  ) {}

  /** Reads the description. Throws SceneError. */
  static async open(source: BlobSource): Promise<SceneData> {
    const scene = parseScene(await source.description());
    const missing = source.firstMissing(blobNames(scene));
    if (missing !== null) throw new SceneError(`Damaged scene: ${missing} is missing.`);
    return new SceneData(source, scene);
  }

  hasMap(view: number, kind: MapKind, side: Side = "own"): boolean {
    return this.mapName(view, kind, side) !== undefined;
  }

  /** The picture of a view that has one. */
  picture(view: number): Promise<ImageBitmap> {
    const entry = this.scene.views[view]!;
    return this.cache.get(`picture ${view}`, 4 * entry.width * entry.height, () =>
      this.decodePicture(entry),
    ) as Promise<ImageBitmap>;
  }

  /** A map of a view that has it. */
  map(view: number, kind: MapKind, side: Side = "own"): Promise<Codes> {
    const entry = this.scene.views[view]!;
    const name = this.mapName(view, kind, side);
    if (name === undefined) throw new Error(`${entry.name} has no map of ${kind}`);
    const bytesPerPixel = kind === "value" || kind === "error" ? 2 : 1;
    return this.cache.get(`map ${name}`, bytesPerPixel * entry.width * entry.height, () =>
      this.decodeMap(entry, name, bytesPerPixel),
    ) as Promise<Codes>;
  }

  /** Score curves [row][column][hypothesis] of a scene that has them: 0 … 254, 255 is not tested. */
  async scores(): Promise<Uint8Array> {
    const { rows, columns, hypotheses, blob } = this.scene.scores!;
    const size = rows * columns * hypotheses.count;
    return this.cache.get("scores", size, async () =>
      gunzip(await this.source.bytes(blob), size, blob),
    ) as Promise<Uint8Array>;
  }

  private mapName(view: number, kind: MapKind, side: Side): string | undefined {
    const entry = this.scene.views[view]!;
    if (side === "own") return entry.maps?.[kind];
    return this.scene.compare?.maps[entry.name]?.[kind];
  }

  private async decodePicture(entry: ViewEntry): Promise<ImageBitmap> {
    const name = entry.image;
    if (name === null) throw new Error(`${entry.name} has no picture`);
    const bytes = await this.source.bytes(name);
    const type = bytes[0] === 0x89 ? "image/png" : "image/jpeg";
    let bitmap: ImageBitmap;
    try {
      bitmap = await createImageBitmap(new Blob([bytes], { type }), {
        colorSpaceConversion: "none",
        premultiplyAlpha: "none",
      });
    } catch {
      throw new SceneError(`Damaged scene: ${name} is not a picture.`);
    }
    if (bitmap.width !== entry.width || bitmap.height !== entry.height) {
      throw new SceneError(
        `Damaged scene: ${name} has ${bitmap.width} × ${bitmap.height} px instead of ${entry.width} × ${entry.height}.`,
      );
    }
    return bitmap;
  }

  private async decodeMap(entry: ViewEntry, name: string, bytesPerPixel: number): Promise<Codes> {
    const { width, height } = entry;
    const bytes = await gunzip(await this.source.bytes(name), bytesPerPixel * width * height, name);
    return bytesPerPixel === 2
      ? decodeCodes16(bytes, width, height)
      : decodeCodes8(bytes, width, height);
  }
}

/** All blobs that a scene names. */
function blobNames(scene: Scene): string[] {
  const maps = [
    ...scene.views.map((view) => view.maps ?? {}),
    ...Object.values(scene.compare?.maps ?? {}),
  ];
  return [
    ...scene.views.map((view) => view.image),
    ...maps.flatMap((names) => Object.values(names)),
    scene.scores?.blob ?? null,
    scene.cloud?.blob ?? null,
    scene.mesh?.blob ?? null,
  ].filter((name) => name !== null);
}
