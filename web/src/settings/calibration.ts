// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The dialog that measures the screen: the outline of a card is made as wide as a real card that is held against it.
import { rounded, t } from '../language';
import { element } from '../dom';
import { card, cssPixel, measuredPixel } from './screen_size';

/** CSS pixels: below that a card's long side lies beyond the borders of a phone's screen, so the card is held upright. */
const narrow = 600;
const least = 30;

export class Calibration {
  private readonly input = element<HTMLInputElement>('card-width');
  private side = card.long;

  /** `done`: millimetres per device pixel; 0: the measurement is forgotten. */
  constructor(done: (pixelSize: number) => void) {
    const dialog = element<HTMLDialogElement>('screen-dialog');
    this.input.addEventListener('input', () => this.draw());
    dialog.addEventListener('close', () => {
      if (dialog.returnValue === 'keep') done(measuredPixel(this.side, this.input.valueAsNumber, window.devicePixelRatio));
      if (dialog.returnValue === 'forget') done(0);
    });
  }

  /** `pixelSize`: as measured before, 0 if not. */
  open(pixelSize: number): void {
    this.side = window.innerWidth < narrow ? card.short : card.long;
    const dialog = element<HTMLDialogElement>('screen-dialog');
    dialog.returnValue = '';
    dialog.showModal();
    this.input.min = String(least);
    this.input.max = String(Math.max(2 * least, element('card-frame').clientWidth));
    this.input.step = '1';
    this.input.value = String(Math.round(this.side / cssPixel(pixelSize, window.devicePixelRatio)));
    element('card-side').textContent = this.side === card.long ? t('long') : t('short');
    this.draw();
    this.input.focus();
  }

  private draw(): void {
    const width = this.input.valueAsNumber;
    const other = this.side === card.long ? card.short : card.long;
    const words = t('{count} pixels of {side} mm', { count: width, side: rounded(this.side / width, 3) });
    const { style } = element('card');
    style.width = `${width}px`;
    style.height = `${(width * other) / this.side}px`;
    this.input.setAttribute('aria-valuetext', words);
    element('card-width-value').textContent = words;
  }
}
