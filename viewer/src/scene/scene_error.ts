// SPDX-License-Identifier: BSD-3-Clause

/** Something about the scene is wrong; the message is one line for the reader. */
export class SceneError extends Error {}

/** One line of whatever was thrown. */
export function oneLine(reason: unknown): string {
  const text = reason instanceof Error ? reason.message : String(reason);
  return text.replace(/\s+/g, " ").trim();
}
