// SPDX-License-Identifier: BSD-3-Clause
// The scene file of the viewer, version 1, as `gigaray view` writes it. See README.md for words.

/** Newest version of the scene file that this page can read. */
export const SCENE_VERSION = 1;

/** The maps that a view may have. All but `value` are optional. */
export type MapKind = "value" | "confidence" | "level" | "error";

export const MAP_KINDS: readonly MapKind[] = ["value", "confidence", "level", "error"];

/** The pinhole of a view for the size shown: x right, y down, z ahead, pixel centres at integers. */
export interface CameraEntry {
  /** px */
  focal: [number, number];
  /** px */
  centre: [number, number];
  /** Scene to camera, row major. */
  rotation: number[];
  /** Scene to camera. */
  translation: [number, number, number];
}

export interface ViewEntry {
  name: string;
  /** View steps; grows as the camera moves to the right. */
  s: number;
  /** View steps; grows as the camera moves down. */
  t: number;
  /** px, of what is shown */
  width: number;
  height: number;
  /** Name of a blob, JPEG or PNG. */
  image: string | null;
  camera: CameraEntry;
  /** Names of blobs. */
  maps: Partial<Record<MapKind, string>> | null;
}

export interface Range {
  min: number;
  max: number;
}

export interface ScoreCurves {
  /** Index of the view that they belong to. */
  view: number;
  /** px shown between two curves, across and down */
  step: number;
  columns: number;
  rows: number;
  hypotheses: Range & { count: number };
  blob: string;
}

export interface Scene {
  format: "gigaray scene";
  version: number;
  title: string;
  kind: "3D" | "4D" | "unstructured";
  /** What value maps hold; larger is nearer. `min` and `max` are the range of the 16-bit code. */
  value: Range & { name: string; unit: string };
  /** px shown per px of the result's pictures. Values stay in full-size px per view step. */
  scale: number;
  /** What makes scene units of values, where it is known. */
  depth: { unit: string; focal_times_baseline?: number; disparity_at_infinity?: number } | null;
  /** Index of the view that is shown first. */
  top_view: number;
  views: ViewEntry[];
  /** Inverse depth for the views' cameras: per_value * value + at_zero. */
  inverse_depth: { per_value: number; at_zero: number };
  /** Range of the code of error maps; estimate minus truth. */
  error: Range | null;
  confidence: { meaning: string } | null;
  /** `result` is a shell word. */
  segment: { result: string } | null;
  scores: ScoreCurves | null;
  /** Another result's maps by the name of the view, in the same code. */
  compare: { title: string; maps: Record<string, Partial<Record<MapKind, string>>> } | null;
  cloud: { blob: string } | null;
  mesh: { blob: string } | null;
  /** A server answers `probe`. */
  live: boolean;
}

/** True for light fields whose views differ by a shift alone. */
export function isParallel(scene: Scene): boolean {
  return scene.kind !== "unstructured";
}
