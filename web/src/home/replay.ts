// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The replay of a recording on this page: what it shows instead of the touch, which goes on unseen. Where a device is in somebody's
// hand it is paused, since the keys that stop its force belong to the replay.
import { element } from '../dom';
import type { Scene, State } from '../generated/protocol';
import type { Probes } from '../probe/probes';
import { ReplayPanel } from '../replay/replay_panel';
import { Importance } from '../sound/announcer';
import type { Sound } from '../sound/sound';
import type { Surface } from '../surface';
import type { Stage } from '../view/stage';
import type { Readouts } from './readouts';

export interface ReplayParts {
  probes: Probes;
  readouts: Readouts;
  stage: Stage;
  sound: Sound;
  scene(): Scene | null;
  surface(): Surface | null;
  heightFactor(): number;
  showState(state: State): void;
  showStatus(): void;
  /** A recording is open now: what is offered besides is withdrawn. */
  opened(): void;
  draw(): void;
  /** Whether a device, and not the page, moves the first probe; and ending its force. */
  byDevice(): boolean;
  pause(): void;
  paused(): boolean;
  /** Requests a frame. */
  request(): void;
  say(words: string, importance: Importance): void;
}

export class Replay {
  readonly panel: ReplayPanel;

  constructor(private readonly parts: ReplayParts) {
    this.panel = new ReplayPanel({
      surface: () => parts.surface(),
      heightFactor: () => parts.heightFactor(),
      sceneName: () => parts.scene()?.name ?? '',
      show: (state, jumped) => {
        if (jumped) parts.readouts.jump();
        parts.showState(state);
      },
      changed: () => this.changed(),
      say: (words) => parts.say(words, Importance.answer),
      tell: (words) => parts.say(words, Importance.news),
      enter: (label) => this.enter(label),
      paused: () => parts.paused(),
      request: () => parts.request(),
      canvas: () => parts.stage.canvas,
      tap: () => parts.sound.tap(),
      untap: () => parts.sound.untap(),
    });
  }

  get isOpen(): boolean {
    return this.panel.isOpen;
  }

  private enter(label: number): void {
    const name = this.parts.scene()?.labels[label] ?? null;
    if (name !== null) this.parts.say(name, Importance.motion);
  }

  private changed(): void {
    const { probes, readouts } = this.parts;
    if (this.isOpen) {
      this.parts.opened();
      if (this.parts.byDevice()) this.parts.pause();
    }
    probes.areReplayed = this.isOpen;
    probes.forget();
    readouts.jump();
    element('stage').closest('.touch')!.toggleAttribute('data-replaying', this.isOpen);
    this.parts.showStatus();
    this.parts.draw();
    this.parts.request();
  }
}
