// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Settings with their undo, and their exchange with the program: what is wished goes there, what holds comes back.
import type { Settings, TouchWishes } from './controls';
import type { Change, Settings as Told } from './generated/protocol';
import { History } from './history';
import { defaults } from './preferences';

/** How long to wait for the answer to a change before believing whatever is told (ms). */
const answerTime = 3000;
const names: Record<string, string> = { exaggeration: 'depth', law: 'force law', damping_Ns_per_m: 'damping' };

export class SettingsKeeper {
  private readonly history: History<Settings>;
  /** What held when the page came; null before it is known. */
  private begun: TouchWishes | null = null;
  /** What the program was last asked for, or said by itself. */
  private asked: TouchWishes | null = null;
  private askedAt = -Infinity;
  private serial: number;

  constructor(
    initial: Settings,
    private readonly send: (change: Change) => void,
    private readonly now: () => number = () => performance.now(),
    firstSerial = Math.floor(Math.random() * 2 ** 31),
  ) {
    this.history = new History(initial);
    this.serial = firstSerial;
  }

  get settings(): Settings {
    return this.history.now;
  }
  get canUndo(): boolean {
    return this.history.canUndo;
  }
  get canRedo(): boolean {
    return this.history.canRedo;
  }
  /** Whether the person has changed anything here. */
  get wasUsed(): boolean {
    return this.canUndo || this.canRedo;
  }

  change(settings: Settings, what: string): void {
    this.history.change(settings, what, this.now());
    this.ask();
  }

  reset(): void {
    this.change({ touch: this.begun ?? this.settings.touch, page: { ...defaults } }, 'reset');
  }

  /** In words what became different, or null if there was nothing to undo or redo. */
  undoOrRedo(which: 'undo' | 'redo'): string | null {
    const before = this.settings;
    if (!this.history[which]()) return null;
    this.ask();
    return difference(before, this.settings);
  }

  /** A new connection: what was asked before was perhaps never heard. */
  connected(): void {
    this.asked = null;
  }

  /** What holds, by the program. False if it answers an earlier change than the last: a slider is still dragged. */
  told({ answers, law, stiffness, damping_Ns_per_m, friction, exaggeration }: Told): boolean {
    if (this.asked !== null && answers !== this.serial && this.now() - this.askedAt < answerTime) return false;
    const touch = { law, stiffness, damping_Ns_per_m, friction, exaggeration };
    this.asked = touch;
    const settings = { ...this.settings, touch };
    if (this.begun === null) {
      this.begun = touch;
      this.history.restart(settings);
    } else {
      this.history.correct(settings);
    }
    return true;
  }

  private ask(): void {
    const { touch } = this.settings;
    if (this.begun === null || sameTouch(touch, this.asked ?? this.begun)) return;
    this.asked = touch;
    this.serial = (this.serial + 1) % 2 ** 32;
    this.askedAt = this.now();
    this.send({ type: 'change', serial: this.serial, ...touch });
  }
}

function sameTouch(a: TouchWishes, b: TouchWishes): boolean {
  return Object.keys(a).every((key) => a[key as keyof TouchWishes] === b[key as keyof TouchWishes]);
}

function difference(a: Settings, b: Settings): string {
  const between = (before: object, after: object) =>
    Object.entries(after).filter(([key, value]) => value !== (before as Record<string, unknown>)[key]).map(([key]) => names[key] ?? key);
  return [...between(a.touch, b.touch), ...between(a.page, b.page)].join(', ');
}
