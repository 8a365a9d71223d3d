// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Zooming, moving and resetting the picture by keys and buttons, with spoken messages.
import { element } from '../dom';
import type { Stage } from '../view/stage';

export class ViewActions {
  constructor(
    private readonly stage: Stage,
    private readonly say: (words: string) => void,
  ) {}

  zoom(factor: number): void {
    this.stage.zoom(factor);
    this.say(`Zoom ${Math.round(100 * this.stage.magnification)} percent.`);
  }
  reset(): void {
    this.stage.resetView();
    this.say('The picture was reset.');
  }
  /** Switches drags and arrows between moving the picture and the probe. */
  toggleMoving(): void {
    const moving = !this.stage.isMovingView;
    this.stage.setViewMoving(moving);
    element('move-view').setAttribute('aria-pressed', String(moving));
    element('arrows-move-probe').hidden = moving;
    element('arrows-move-picture').hidden = !moving;
    this.say(moving ? 'Arrows turn the picture, with Shift they shift it. C moves the probe again.' : 'Arrows move the probe.');
  }
}
