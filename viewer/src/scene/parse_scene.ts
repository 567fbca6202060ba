// SPDX-License-Identifier: BSD-3-Clause

import { Field } from "./field";
import {
  type CameraEntry,
  MAP_KINDS,
  type MapKind,
  type Range,
  SCENE_VERSION,
  type Scene,
  type ViewEntry,
} from "./format";
import { SceneError } from "./scene_error";

/** No picture or map of a view is larger, so that sizes from a damaged file allocate nothing. */
const MAX_SIZE_PX = 16384;
const MAX_VIEWS = 100000;

/** Reads and checks a scene file. Throws SceneError with one line for whatever is wrong first. */
export function parseScene(text: string): Scene {
  let json: unknown;
  try {
    json = JSON.parse(text);
  } catch {
    throw new SceneError("Damaged scene: its description is not JSON.");
  }
  const file = new Field(json, "");
  if (typeof json !== "object" || json === null || file.at("format").value !== "gigaray scene") {
    throw new SceneError("Damaged scene: this is not the description of a gigaray scene.");
  }
  const version = file.at("version").integer(1, 1e9);
  if (version > SCENE_VERSION) {
    throw new SceneError(
      `This scene is of version ${version}; this page reads up to version ${SCENE_VERSION}. Write it again with the gigaray that shows it.`,
    );
  }
  const views = file.at("views").list().map(readView);
  if (views.length === 0 || views.length > MAX_VIEWS) file.at("views").fail("a list of views");
  checkNames(views);
  return {
    format: "gigaray scene",
    version,
    title: file.at("title").string(),
    kind: readKind(file.at("kind")),
    value: {
      name: file.at("value").at("name").string(),
      unit: file.at("value").at("unit").string(),
      ...readRange(file.at("value")),
    },
    scale: file.at("scale").positive(),
    depth: file.at("depth").optional(readDepth),
    top_view: file.at("top_view").integer(0, views.length - 1),
    views,
    inverse_depth: {
      per_value: file.at("inverse_depth").at("per_value").number(),
      at_zero: file.at("inverse_depth").at("at_zero").number(),
    },
    error: readErrorRange(file.at("error"), views),
    confidence: file
      .at("confidence")
      .optional((field) => ({ meaning: field.at("meaning").string() })),
    segment: file.at("segment").optional((field) => ({ result: field.at("result").string() })),
    scores: file.at("scores").optional((field) => readScores(field, views.length)),
    compare: file.at("compare").optional(readCompare),
    cloud: file.at("cloud").optional(readBlob),
    mesh: file.at("mesh").optional(readBlob),
    live: file.at("live").value === true,
  };
}

function readKind(field: Field): Scene["kind"] {
  const kind = field.string();
  if (kind === "3D" || kind === "4D" || kind === "unstructured") return kind;
  return field.fail("3D, 4D or unstructured");
}

function readRange(field: Field): Range {
  const range = { min: field.at("min").number(), max: field.at("max").number() };
  if (range.min >= range.max) field.at("max").fail("above its min");
  return range;
}

function readDepth(field: Field): NonNullable<Scene["depth"]> {
  const depth: NonNullable<Scene["depth"]> = { unit: field.at("unit").string() };
  if (field.at("focal_times_baseline").value !== undefined) {
    depth.focal_times_baseline = field.at("focal_times_baseline").positive();
    depth.disparity_at_infinity = field.at("disparity_at_infinity").number();
  }
  return depth;
}

function readErrorRange(field: Field, views: ViewEntry[]): Range | null {
  const needed = views.some((view) => view.maps?.error !== undefined);
  return needed ? readRange(field) : field.optional(readRange);
}

function readView(field: Field): ViewEntry {
  return {
    name: field.at("name").string(),
    s: field.at("s").number(),
    t: field.at("t").number(),
    width: field.at("width").integer(1, MAX_SIZE_PX),
    height: field.at("height").integer(1, MAX_SIZE_PX),
    image: field.at("image").optional((image) => image.string()),
    camera: readCamera(field.at("camera")),
    maps: field.at("maps").optional(readMaps),
  };
}

function readCamera(field: Field): CameraEntry {
  const [focalU, focalV] = field.at("focal").list(2);
  return {
    focal: [focalU!.positive(), focalV!.positive()],
    centre: field.at("centre").numbers(2) as [number, number],
    rotation: field.at("rotation").numbers(9),
    translation: field.at("translation").numbers(3) as [number, number, number],
  };
}

function readMaps(field: Field): Partial<Record<MapKind, string>> {
  const maps: Partial<Record<MapKind, string>> = {};
  for (const kind of MAP_KINDS) {
    const name = field.at(kind).optional((map) => map.string());
    if (name !== null) maps[kind] = name;
  }
  if (maps.value === undefined) field.at("value").fail("the name of a map");
  return maps;
}

function checkNames(views: ViewEntry[]): void {
  const names = new Set<string>();
  for (const view of views) {
    if (names.has(view.name)) {
      throw new SceneError(`Damaged scene: two views are named ${view.name}.`);
    }
    names.add(view.name);
  }
}

function readScores(field: Field, views: number): NonNullable<Scene["scores"]> {
  const hypotheses = field.at("hypotheses");
  return {
    view: field.at("view").integer(0, views - 1),
    step: field.at("step").integer(1, MAX_SIZE_PX),
    columns: field.at("columns").integer(1, MAX_SIZE_PX),
    rows: field.at("rows").integer(1, MAX_SIZE_PX),
    hypotheses: { ...readRange(hypotheses), count: hypotheses.at("count").integer(2, 65536) },
    blob: field.at("blob").string(),
  };
}

function readCompare(field: Field): NonNullable<Scene["compare"]> {
  const maps: Record<string, Partial<Record<MapKind, string>>> = {};
  for (const [name, entry] of field.at("maps").entries()) maps[name] = readMaps(entry);
  return { title: field.at("title").string(), maps };
}

function readBlob(field: Field): { blob: string } {
  return { blob: field.at("blob").string() };
}
