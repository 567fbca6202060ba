// SPDX-License-Identifier: BSD-3-Clause

/** Keeps what was made by key; beyond a budget of bytes it drops what was used longest ago. */
export class ByteCache<T> {
  private readonly entries = new Map<string, { value: Promise<T>; bytes: number }>();
  private bytes = 0;

  constructor(private readonly budget: number) {}

  /** What is kept for the key, or what `make` promises. What fails is not kept. */
  get(key: string, bytes: number, make: () => Promise<T>): Promise<T> {
    const kept = this.entries.get(key);
    if (kept !== undefined) {
      // A Map keeps the order of insertion: the first entry is the one used longest ago.
      this.entries.delete(key);
      this.entries.set(key, kept);
      return kept.value;
    }
    const value = make();
    this.entries.set(key, { value, bytes });
    this.bytes += bytes;
    value.catch(() => this.drop(key));
    for (const oldest of this.entries.keys()) {
      if (this.bytes <= this.budget || oldest === key) break;
      this.drop(oldest);
    }
    return value;
  }

  private drop(key: string): void {
    const entry = this.entries.get(key);
    if (entry === undefined) return;
    this.entries.delete(key);
    this.bytes -= entry.bytes;
  }
}
