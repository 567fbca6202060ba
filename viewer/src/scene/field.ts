// SPDX-License-Identifier: BSD-3-Clause
// Reads fields of JSON of unknown shape; whatever is wrong becomes one line with the field's path.

import { SceneError } from "./scene_error";

/** A value of the file together with the place where it was read. */
export class Field {
  constructor(
    readonly value: unknown,
    readonly path: string,
  ) {}

  fail(expected: string): never {
    const found = this.value === undefined ? "is missing" : `is not ${expected}`;
    throw new SceneError(`Damaged scene: ${this.path} ${found}.`);
  }

  /** The field `key` of an object. */
  at(key: string): Field {
    if (typeof this.value !== "object" || this.value === null || Array.isArray(this.value)) {
      this.fail("an object");
    }
    const path = this.path === "" ? key : `${this.path}.${key}`;
    const object = this.value as Record<string, unknown>;
    return new Field(Object.hasOwn(object, key) ? object[key] : undefined, path);
  }

  /** All fields of an object. */
  entries(): [string, Field][] {
    this.at("");
    return Object.keys(this.value as object).map((key) => [key, this.at(key)]);
  }

  /** The elements of a list; of `length` elements where it is given. */
  list(length?: number): Field[] {
    if (!Array.isArray(this.value)) this.fail("a list");
    const list = this.value as unknown[];
    if (length !== undefined && list.length !== length) this.fail(`a list of ${length}`);
    return list.map((value, idx) => new Field(value, `${this.path}[${idx}]`));
  }

  string(): string {
    if (typeof this.value !== "string") this.fail("text");
    return this.value as string;
  }

  number(): number {
    if (typeof this.value !== "number" || !Number.isFinite(this.value)) this.fail("a number");
    return this.value as number;
  }

  positive(): number {
    if (this.number() <= 0) this.fail("above zero");
    return this.value as number;
  }

  /** An integer from `min` to `max`, both included. */
  integer(min: number, max: number): number {
    if (!Number.isInteger(this.value) || this.number() < min || this.number() > max) {
      this.fail(`an integer from ${min} to ${max}`);
    }
    return this.value as number;
  }

  numbers(length: number): number[] {
    return this.list(length).map((field) => field.number());
  }

  /** What `read` makes of it, or null where the file has nothing. */
  optional<T>(read: (field: Field) => T): T | null {
    return this.value === null || this.value === undefined ? null : read(this);
  }
}
