// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Zooming, moving and resetting the picture by keys and buttons, with spoken messages.
import { t } from '../language';
import { element } from '../dom';
import type { Moves, Stage } from '../view/stage';

export class ViewActions {
  constructor(
    private readonly stage: Stage,
    private readonly say: (words: string) => void,
  ) {}

  zoom(factor: number): void {
    this.stage.zoom(factor);
    this.say(t('Zoom {magnification} percent.', { magnification: Math.round(100 * this.stage.magnification) }));
  }
  reset(): void {
    this.stage.resetView();
    this.say(t('The picture was reset.'));
  }
  /** Switches drags and arrows between moving the picture and the probe. */
  toggleMoving(): void {
    this.toggle('picture', t('Arrows turn the picture, with Shift they shift it. C moves the probe again.'));
  }
  /** Switches them between moving the head and the probe. */
  toggleHead(): void {
    if (this.stage.fit === null && this.stage.moving !== 'head') return this.say(t('The head’s place counts in a depth mode only. Choose one under Look, True depth on the screen.'));
    this.toggle('head', t('Arrows move your head, with Shift up and down nearer and farther away. V moves the probe again.'));
  }

  /** Call it when the settings have changed: without a depth mode the arrows do not move the head. */
  follow(): void {
    if (this.stage.fit === null && this.stage.moving === 'head') this.toggleHead();
  }

  private toggle(moves: Moves, words: string): void {
    const begins = this.stage.moving !== moves;
    const now = begins ? moves : 'probe';
    this.stage.setMoving(now);
    element('move-view').setAttribute('aria-pressed', String(now === 'picture'));
    element('move-head').setAttribute('aria-pressed', String(now === 'head'));
    for (const one of ['probe', 'picture', 'head'] as const) element(`arrows-move-${one}`).hidden = one !== now;
    this.say(begins ? words : t('Arrows move the probe.'));
    // The arrows act there, not on the button.
    const pressed = document.activeElement?.id;
    if (begins && (pressed === 'move-view' || pressed === 'move-head')) element('stage').focus();
  }
}
