// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Registers a device with the screen: three marks are touched with the handle, then the scene is drawn where the hand feels it.
import { fixed, t } from '../language';
import { element } from '../dom';
import type { DevicePlace, Scene, State } from '../generated/protocol';
import type { Preferences } from '../settings/preferences';
import { cornerOnScreen, cssPixel } from '../settings/screen_size';
import type { ScreenPoint } from '../view/depth/frustum';
import { beneath, mostResidual, registrationOf, type Registration, type RegistrationFault, type Triple } from '../view/depth/registration';
import { fillsCanvas, layouts } from '../view/depth/layout';
import type { Stage } from '../view/stage';
import type { DepthTarget } from './depth_panel';
import { RestingHand } from './resting_hand';

/** The marks on the stage, in shares of it; no two sides of their triangle are alike, so exchanged marks are noticed. */
const shares: Triple<{ across: number; down: number }> = [{ across: 0.12, down: 0.85 }, { across: 0.88, down: 0.85 }, { across: 0.3, down: 0.15 }];

/** Degrees by which a turn of the device in the scene is more than noise, and metres by which a shift is. */
const mostTurned = 0.1;
const leastShift = 1e-4;
const noShift = { x_m: 0, y_m: 0, z_m: 0 };
const shiftOf = (a: DevicePlace, b: DevicePlace): number => Math.hypot(a.x_m - b.x_m, a.y_m - b.y_m, a.z_m - b.z_m);

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
  /** Of the device's own workspace; null: none. */
  private registered: Registration | null = null;
  /** For what the registration holds. */
  private holdsFor = '';
  /** Where the device is in the scene, and where it was when the scene was drawn last. */
  private device: DevicePlace | null = null;
  private drawnFor: DevicePlace | null = null;
  private corner = { left: 0, top: 0 };

  constructor(
    private readonly stage: Stage,
    private readonly target: RegistrationTarget,
  ) {
    this.mark.className = 'registration-mark';
    this.mark.setAttribute('aria-hidden', 'true');
    this.button.addEventListener('click', () => (this.registered !== null ? this.forget(t('The scene is in the middle of the picture again.')) : this.begin()));
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

  /** The scene's size, the screen's measure or the turn of the device in the scene has changed. */
  private moved(): void {
    if (this.touched !== null) this.leave();
    if (this.registered === null) return;
    // After the answer to what changed it, which would replace it.
    const sentence = t('The scene’s place under the hand has changed: it is in the middle of the picture again, and can be put where the hand is once more.');
    this.forget(sentence, (words) => this.target.tell(words));
  }

  /** Where the device's hand is, and the device, in the scene. */
  felt({ probes, device }: State, now: number): void {
    const isTurned = this.device !== null && Math.abs(device.turned_deg - this.device.turned_deg) > mostTurned;
    this.device = device;
    if (isTurned) this.moved();
    const hand = probes[0];
    if (this.touched !== null && hand?.probe === 0) this.hand.add({ x: hand.x_m - device.x_m, y: hand.y_m - device.y_m, z: hand.z_m - device.z_m }, now);
    if (this.registered !== null && this.drawnFor !== null && shiftOf(device, this.drawnFor) > leastShift) this.place(this.registered);
  }

  /** Call it for each frame: the page may have been scrolled, or its window moved. */
  frame(): void {
    if (this.registered === null) return;
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
    this.registered = found.registration;
    this.place(this.registered);
    this.holdsFor = this.conditions();
    this.showButton();
    this.tell(t('The scene is where the hand feels it, within {value} millimetres at the marks. Space goes on with the touch.', { value: fixed(1000 * found.residual, 1) }));
  }

  /** Draws the scene where the hand feels it now: a clutch, the border of the workspace or recentring may have moved it. */
  private place(registration: Registration): void {
    this.drawnFor = this.device;
    const { x_m: x, y_m: y, z_m: z } = this.device ?? noShift;
    this.stage.register(beneath(registration, { x, y, z }));
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
    this.registered = null;
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
    this.button.textContent = this.registered !== null ? t('Put the scene back into the middle') : t('Put the scene where the hand is');
  }
  private tell(sentence: string, say = (words: string) => this.target.say(words)): void {
    element('registration-words').textContent = sentence;
    say(sentence);
  }
}
