// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The headset in the depth settings: its button, why there is none, and what is said when it begins and ends.
import { element } from '../dom';
import type { Pointing } from '../probe/pointers';
import type { Preferences } from '../settings/preferences';
import type { Surface } from '../surface';
import { headsetMode, isMode, type HeadsetMode, type HeadsetObstacle } from '../view/headset/support';
import { faultWords, headsetWords as words, obstacleWords, sizeWords } from '../view/headset/words';
import type { Stage } from '../view/stage';
import type { FrameLoop } from './frame_loop';

export interface HeadsetPanelTarget {
  readonly frames: FrameLoop;
  readonly pointing: Pointing;
  page(): Preferences;
  surface(): Surface | null;
  say(words: string): void;
  /** A user action: sound may start. */
  wake(): void;
  /** What vibrates in the hands; null: nothing. */
  hold(pads: (() => readonly Gamepad[]) | null): void;
}

export class HeadsetPanel {
  private readonly button = element<HTMLButtonElement>('show-headset');
  private found: HeadsetMode | HeadsetObstacle = 'no headset';
  /** `ending`: the page has asked for the end. */
  private state: 'off' | 'starting' | 'on' | 'ending' = 'off';

  constructor(
    private readonly stage: Stage,
    private readonly target: HeadsetPanelTarget,
  ) {
    // Asking may start the headset's own program: not before somebody looks at these settings.
    element('depth').addEventListener('toggle', () => void this.look());
    navigator.xr?.addEventListener('devicechange', () => {
      if (element<HTMLDetailsElement>('depth').open) void this.look();
    });
    this.button.addEventListener('click', () => (this.state === 'on' ? this.leave() : void this.show()));
    window.addEventListener('pagehide', () => this.stage.headset?.leave());
    this.follow();
  }

  /** Call it when the settings or the scene have changed. */
  follow(): void {
    const { headset } = this.stage;
    const isOn = this.state === 'on';
    document.documentElement.dataset.headset = this.state;
    this.button.hidden = !isMode(this.found);
    element('headset-size-row').hidden = !isMode(this.found);
    this.button.disabled = headset === null || this.state === 'starting' || this.state === 'ending';
    this.button.textContent = isOn ? words.leave : words.show;
    element('headset-words').textContent = this.words();
  }

  /** Ends it; false if the scene is on the screen. */
  leave(): boolean {
    if (this.state !== 'on') return false;
    this.state = 'ending';
    this.stage.headset?.leave();
    return true;
  }

  private words(): string {
    if (!isMode(this.found)) return obstacleWords[this.found];
    if (this.state === 'starting') return words.waiting;
    const surface = this.target.surface();
    if (this.stage.headset === null) return words.flat;
    return surface === null ? '' : sizeWords(surface, this.target.page().headsetSize);
  }

  private async look(): Promise<void> {
    this.found = await headsetMode(navigator.xr, window.isSecureContext);
    this.follow();
  }

  private async show(): Promise<void> {
    const { headset } = this.stage;
    if (headset === null || !isMode(this.found) || this.state !== 'off') return;
    const { frames, pointing } = this.target;
    this.state = 'starting';
    this.target.wake();
    // Shown only: said, it would delay what follows, until that is out of date on a slow machine.
    this.follow();
    const fault = await headset.show(this.found, {
      drives: (now) => frames.drive(now),
      frame: () => frames.tick(),
      ended: () => this.ended(),
      aim: (pointer, place) => pointing.aim(pointer, place),
      press: (pointer, place) => pointing.press(pointer, place),
      release: (pointer) => pointing.release(pointer),
    });
    // It may have ended meanwhile, which was said.
    if (this.state !== 'starting') return;
    this.state = fault === null ? 'on' : 'off';
    this.target.say(fault === null ? words.began : faultWords[fault]);
    this.follow();
    if (fault !== null) return;
    this.target.hold(() => headset.pads);
    this.stage.element.focus({ preventScroll: true });
  }

  private ended(): void {
    const wanted = this.state === 'ending';
    this.state = 'off';
    this.target.hold(null);
    this.target.say(wanted ? words.left : words.lost);
    this.follow();
  }
}
