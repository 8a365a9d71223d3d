// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// True depth on the screen in the settings: what is shown of the depth in words, measuring the screen, and full screen.
import { t } from '../language';
import { element } from '../dom';
import { Calibration } from '../settings/calibration';
import type { Preferences } from '../settings/preferences';
import { cssPixel } from '../settings/screen_size';
import type { Fit } from '../view/depth/fit';
import { SettledWords } from '../sound/settled_words';
import { comfortWords, depthWords } from '../view/depth/words';
import type { Stage } from '../view/stage';

export interface DepthTarget {
  page(): Preferences;
  change(page: Partial<Preferences>, what: string): void;
  say(words: string): void;
  /** Says it after what was asked for. */
  tell(words: string): void;
}

export class DepthPanel {
  private shown: Fit | null = null;
  private readonly comfort: SettledWords;

  constructor(
    private readonly stage: Stage,
    private readonly target: DepthTarget,
  ) {
    this.comfort = new SettledWords((words) => target.tell(words));
    const calibration = new Calibration((pixelSize) => {
      target.change({ pixelSize }, 'pixelSize');
      target.say(this.screenWords());
    });
    element('measure-screen').addEventListener('click', () => calibration.open(target.page().pixelSize));
    element('full-screen').hidden = !document.fullscreenEnabled;
    element('full-screen').addEventListener('click', () => this.fillScreen());
  }

  /** Call it for each frame. */
  frame(): void {
    if (this.stage.fit !== this.shown) this.show();
  }

  /** Shows what is shown of the depth. */
  show(): void {
    this.shown = this.stage.fit;
    element('depth-words').textContent = this.words();
    element('screen-words').textContent = this.screenWords();
    this.comfort.set(this.comfortWords());
  }

  /** The depth mode and what it shows, in words. */
  say(): void {
    const option = element<HTMLSelectElement>('depth-mode').selectedOptions[0];
    const group = option?.parentElement instanceof HTMLOptGroupElement ? `${option.parentElement.label}: ` : '';
    this.comfort.heard(this.comfortWords());
    this.target.say(`${group}${option?.text ?? ''}. ${this.words()}`);
  }

  private comfortWords(): string {
    return comfortWords(this.stage.fit, this.target.page());
  }

  private words(): string {
    if (element<HTMLSelectElement>('view').disabled) return t('True depth needs WebGL, which this browser does not offer.');
    const page = this.target.page();
    return page.view === 'flat' ? t('True depth needs the view in 3D.') : depthWords(this.stage.fit, page, this.stage.showsSecond);
  }

  private screenWords(): string {
    const { pixelSize } = this.target.page();
    const pixel = cssPixel(pixelSize, window.devicePixelRatio);
    const width = Math.round((window.screen.width * pixel) / 10);
    return pixelSize > 0 ? t('The screen is {width} centimetres wide, as measured.', { width }) : t('The screen was not measured: it is taken to be {width} centimetres wide.', { width });
  }

  private fillScreen(): void {
    const { element: stage } = this.stage;
    stage.requestFullscreen().then(
      () => stage.focus({ preventScroll: true }),
      () => this.target.say(t('This browser refuses full screen.')),
    );
  }
}
