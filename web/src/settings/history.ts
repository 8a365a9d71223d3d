// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Undo and redo of settings. Dragging a slider is one step.

export class History<T> {
  private past: T[] = [];
  private future: T[] = [];
  private lastKey = '';
  private lastTime = -Infinity;

  constructor(
    private present: T,
    private readonly mergeWithin = 900,
    private readonly most = 200,
  ) {}

  get now(): T {
    return this.present;
  }
  /** How many steps can be undone. */
  get steps(): number {
    return this.past.length;
  }
  get canUndo(): boolean {
    return this.past.length > 0;
  }
  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** A change of `key` at `time` (ms); changes of one key in quick succession are one step. */
  change(next: T, key: string, time: number): void {
    const merges = key === this.lastKey && time - this.lastTime < this.mergeWithin && this.canUndo;
    if (!merges) this.past.push(this.present);
    if (this.past.length > this.most) this.past.shift();
    this.present = next;
    this.future = [];
    this.lastKey = key;
    this.lastTime = time;
  }

  /** Replaces the current value without a new step (the program lowered a value). */
  correct(next: T): void {
    this.present = next;
  }

  /** Resets the history. */
  restart(present: T): void {
    this.present = present;
    this.past = [];
    this.future = [];
  }

  undo(): boolean {
    return this.step(this.past, this.future);
  }
  redo(): boolean {
    return this.step(this.future, this.past);
  }

  private step(from: T[], to: T[]): boolean {
    const next = from.pop();
    if (next === undefined) return false;
    to.push(this.present);
    this.present = next;
    this.lastKey = '';
    return true;
  }
}
