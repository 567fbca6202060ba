// SPDX-License-Identifier: BSD-3-Clause

/** State that panels read and are told of. Data flows one way: set, then everybody renders. */
export class Store<S extends object> {
  private readonly listeners: ((state: S, before: S) => void)[] = [];

  constructor(private state: S) {}

  get(): Readonly<S> {
    return this.state;
  }

  /** Changes some fields; tells nobody where nothing changes. */
  set(changes: Partial<S>): void {
    const before = this.state;
    const keys = Object.keys(changes) as (keyof S)[];
    if (keys.every((key) => Object.is(before[key], changes[key]))) return;
    this.state = { ...before, ...changes };
    for (const listener of this.listeners) listener(this.state, before);
  }

  subscribe(listener: (state: S, before: S) => void): void {
    this.listeners.push(listener);
  }

  /** Calls at once and whenever one of the fields changes. */
  watch(keys: (keyof S)[], render: (state: S) => void): void {
    render(this.state);
    this.subscribe((state, before) => {
      if (keys.some((key) => !Object.is(state[key], before[key]))) render(state);
    });
  }
}
