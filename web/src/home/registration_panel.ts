// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Registers a device with the screen: three marks are touched with the handle, then the scene is drawn where the hand feels it.
import { fixed, t } from '../language';
import { element } from '../dom';
import type { ProbeState, Scene } from '../generated/protocol';
import type { Preferences } from '../settings/preferences';
import { cornerOnScreen, cssPixel } from '../settings/screen_size';
import type { ScreenPoint } from '../view/depth/frustum';
import { mostResidual, registrationOf, type RegistrationFault, type Triple } from '../view/depth/registration';
import { fillsCanvas, layouts } from '../view/depth/layout';
import type { Stage } from '../view/stage';
import type { DepthTarget } from './depth_panel';
import { RestingHand } from './resting_hand';

/** The marks on the stage, in shares of it; no two sides of their triangle are alike, so exchanged marks are noticed. */
const shares: Triple<{ across: number; down: number }> = [{ across: 0.12, down: 0.85 }, { across: 0.88, down: 0.85 }, { across: 0.3, down: 0.15 }];

const faults: Record<RegistrationFault, string> = {
  line: t('The three places are nearly on a line. Nothing was changed; begin again.'),
  apart: t('The three places do not fit the marks: they are more than {most} millimetres off. Nothing was changed; measure the screen, and begin again.', { most: 1000 * mostResidual }),
  behind: t('From these places the scene would be seen from behind. Nothing was changed; begin again.'),
};

export interface RegistrationTarget extends DepthTarget {
  scene(): Scene | null;
  heightFactor(): number;
  paused(): boolean;
  pause(): void;
  /** The marks need the whole picture. */
  begun(): void;
}

export class RegistrationPanel {
  private readonly button = element<HTMLButtonElement>('register-hand');
  private readonly mark = document.createElement('div');
  private readonly hand = new RestingHand();
  /** What was touched so far; null: no registration is going on. */
  private touched: { place: ScreenPoint; mark: ScreenPoint }[] | null = null;
  private isRegistered = false;
  /** For what the registration holds. */
  private holdsFor = '';
  private corner = { left: 0, top: 0 };

  constructor(
    private readonly stage: Stage,
    private readonly target: RegistrationTarget,
  ) {
    this.mark.className = 'registration-mark';
    this.mark.setAttribute('aria-hidden', 'true');
    this.button.addEventListener('click', () => (this.isRegistered ? this.forget(t('The scene is in the middle of the picture again.')) : this.begin()));
    element('registration-next').addEventListener('click', () => this.next());
    element('registration-leave').addEventListener('click', () => this.leave());
    document.addEventListener('keydown', (event) => this.pressed(event), { capture: true });
    window.addEventListener('scroll', () => this.frame(), { passive: true });
  }

  /** A device moves the first probe, and this page is no guest's. */
  offer(isThere: boolean): void {
    element('registration-choice').hidden = !isThere;
    if (!isThere) this.leave();
  }

  /** Call it when the settings or the scene have changed. */
  follow(): void {
    const isFlat = this.target.page().view === 'flat' || element<HTMLSelectElement>('view').disabled;
    this.button.disabled = isFlat;
    if (this.touched !== null && isFlat) this.leave();
    if (this.holdsFor !== '' && this.holdsFor !== this.conditions()) this.moved();
  }

  /** The device's middle, the scene's size or the screen's measure has changed. */
  moved(): void {
    if (this.touched !== null) this.leave();
    if (!this.isRegistered) return;
    // After the answer to what changed it, which would replace it.
    const sentence = t('The scene’s place under the hand has changed: it is in the middle of the picture again, and can be put where the hand is once more.');
    this.forget(sentence, (words) => this.target.tell(words));
  }

  /** Where the device's hand is, in the scene. */
  felt({ x_m: x, y_m: y, z_m: z }: ProbeState, now: number): void {
    if (this.touched !== null) this.hand.add({ x, y, z }, now);
  }

  /** Call it for each frame: the page may have been scrolled, or its window moved. */
  frame(): void {
    if (!this.isRegistered) return;
    const { left, top } = cornerOnScreen(this.stage.element);
    if (left === this.corner.left && top === this.corner.top) return;
    this.corner = { left, top };
    this.stage.placeAgain();
  }

  private begin(): void {
    const mode = this.target.page().depthMode;
    if (mode === 'plain' || !fillsCanvas(layouts[mode])) this.target.change({ depthMode: 'head' }, 'depthMode');
    if (!this.target.paused()) this.target.pause();
    this.target.begun();
    this.touched = [];
    this.hand.forget();
    this.stage.element.append(this.mark);
    element('registration').hidden = false;
    this.stage.element.scrollIntoView({ block: 'nearest' });
    this.stage.element.focus({ preventScroll: true });
    this.showMark();
    this.tell(t('The touch is paused, without force. Touch mark 1 of 3 on the screen with the tip of the handle, hold it still, and press Enter. Escape ends this.'));
  }

  private next(): void {
    if (this.touched === null) return;
    const longer = Math.max(this.target.scene()?.size_x_m ?? 0, this.target.scene()?.size_y_m ?? 0);
    const place = this.hand.place(0.01 * longer, performance.now());
    if (place === null) return this.tell(t('The hand moved. Hold it still, and press Enter again.'));
    this.touched.push({ place, mark: this.markPlace() });
    if (this.touched.length === shares.length) return this.finish(this.touched);
    this.showMark();
    this.tell(t('Touch mark {mark} of 3, hold still, and press Enter.', { mark: this.touched.length + 1 }));
  }

  private finish(touched: readonly { place: ScreenPoint; mark: ScreenPoint }[]): void {
    const triple = <T>(of: (one: { place: ScreenPoint; mark: ScreenPoint }) => T) => touched.map(of) as unknown as Triple<T>;
    const found = registrationOf(triple(({ place }) => place), triple(({ mark }) => mark));
    this.close();
    if (typeof found === 'string') return this.tell(faults[found]);
    this.stage.register(found.registration);
    this.isRegistered = true;
    this.holdsFor = this.conditions();
    this.showButton();
    this.tell(t('The scene is where the hand feels it, within {value} millimetres at the marks. Space goes on with the touch.', { value: fixed(1000 * found.residual, 1) }));
  }

  private leave(): void {
    if (this.touched === null) return;
    this.close();
    this.tell(t('Nothing was changed. Space goes on with the touch.'));
  }

  private close(): void {
    this.touched = null;
    this.mark.remove();
    element('registration').hidden = true;
    this.stage.element.focus({ preventScroll: true });
  }

  private forget(sentence: string, say = (words: string) => this.target.say(words)): void {
    this.isRegistered = false;
    this.holdsFor = '';
    this.stage.register(null);
    this.showButton();
    this.tell(sentence, say);
  }

  private pressed(event: KeyboardEvent): void {
    if (this.touched === null || (event.key !== 'Enter' && event.key !== 'Escape')) return;
    // On a button Enter is its own.
    if (event.key === 'Enter' && event.target !== this.stage.element) return;
    event.preventDefault();
    event.stopPropagation();
    if (event.repeat) return;
    if (event.key === 'Enter') this.next();
    else this.leave();
  }

  /** What a registration depends on. */
  private conditions(): string {
    const scene = this.target.scene();
    const { pixelSize }: Preferences = this.target.page();
    return JSON.stringify([scene?.size_x_m, scene?.size_y_m, scene?.lowest_m, scene?.highest_m, this.target.heightFactor(), cssPixel(pixelSize, window.devicePixelRatio)]);
  }

  private showMark(): void {
    const { across, down } = shares[this.touched?.length ?? 0]!;
    this.mark.style.left = `${100 * across}%`;
    this.mark.style.top = `${100 * down}%`;
    this.mark.textContent = String((this.touched?.length ?? 0) + 1);
  }

  /** Where the shown mark is in the frame of the screen. */
  private markPlace(): ScreenPoint {
    const metres = cssPixel(this.target.page().pixelSize, window.devicePixelRatio) / 1000;
    const { left, top } = cornerOnScreen(this.mark);
    const { width, height } = this.mark.getBoundingClientRect();
    return { x: (left + width / 2) * metres, y: -(top + height / 2) * metres, z: 0 };
  }

  private showButton(): void {
    this.button.textContent = this.isRegistered ? t('Put the scene back into the middle') : t('Put the scene where the hand is');
  }
  private tell(sentence: string, say = (words: string) => this.target.say(words)): void {
    element('registration-words').textContent = sentence;
    say(sentence);
  }
}
