// SPDX-License-Identifier: BSD-3-Clause

import { SceneError } from "./scene_error";

/** The `size` bytes of a gzip stream; `name` is for the message where it is damaged. */
export async function gunzip(
  bytes: Uint8Array<ArrayBuffer>,
  size: number,
  name: string,
): Promise<Uint8Array<ArrayBuffer>> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const reader = stream.getReader();
  const out = new Uint8Array(size);
  let filled = 0;
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      // What is too much is counted but not kept: a damaged size must not take the memory.
      if (filled + value.length <= size) out.set(value, filled);
      filled += value.length;
    }
  } catch {
    throw new SceneError(`Damaged scene: ${name} is not a whole gzip stream.`);
  }
  if (filled !== size) {
    throw new SceneError(`Damaged scene: ${name} has ${filled} bytes instead of ${size}.`);
  }
  return out;
}
