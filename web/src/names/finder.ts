// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Leads a probe to a named place: by words after each step, and by pulses from the place's side.
import { t } from '../language';
import type { Words as Answer } from '../generated/protocol';
import { Importance, type Words } from '../sound/announcer';
import type { Feedback } from '../sound/feedback';
import { directionOf, findInterval, findPitch } from '../sound/sonify';
import type { Place, Surface } from '../surface';

export interface FinderPage {
  surface(): Surface | null;
  /** The probe that is led, and where it is. */
  probe(): number;
  place(): Place;
  /** The program's words on the way from there; its place is null at the end. */
  way(): Promise<Answer | null>;
  say(words: Words | string, importance: Importance): void;
  ended(): void;
  /** The probe is there. */
  found(): void;
}

/** Without a movement for this long the pulses stop (ms). */
const patience = 15_000;
/** After a key press for this long the place may be on the way of further ones (ms), and is no end. */
const settling = 250;
/** For so long after a key press (ms) its words say where the probe is. */
const keysLead = 2000;
/** A probe that is not moved by keys: the way is asked for this often (ms), and said this often. */
const askEvery = 500;
const sayEvery = 3000;
/** Metres of movement on a scene of 0.1 m that count. */
const leastMove = 5e-4;

export class Finder {
  private name: string | null = null;
  /** The name to which the probe was led last; null: none, or it was given up. */
  reached: string | null = null;
  private target: Place | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private from: Place = { x: NaN, y: NaN };
  private movedAt = -Infinity;
  private keyAt = -Infinity;
  private askedAt = -Infinity;
  private saidAt = -Infinity;

  constructor(
    private readonly page: FinderPage,
    private readonly feedback: Feedback,
  ) {}

  get isLeading(): boolean {
    return this.name !== null;
  }
  /** Whether the words of the way are being followed by keys: other words on the motion would replace them. */
  get isFollowedByKeys(): boolean {
    return this.isLeading && performance.now() - this.keyAt < keysLead;
  }

  /** The program leads to the place of this name from now on. */
  begin(name: string): void {
    this.name = name;
    this.reached = this.target = null;
    this.movedAt = performance.now();
    this.from = this.page.place();
    this.page.say(this.words(`${t('Looking for {name}.', { name })} `), Importance.answer);
  }
  stop(): void {
    this.name = this.target = null;
    clearTimeout(this.timer);
    this.page.ended();
  }

  /** The way in words; at its end the place's own. */
  words(before = ''): Words {
    return async () => {
      const text = await this.ask();
      return text && before + text;
    };
  }

  /** The probe may have moved, by whatever: follows it. `byKey`: the words of a key's step follow anyway. */
  moved(byKey: boolean): void {
    const surface = this.page.surface();
    if (this.name === null || surface === null) return;
    if (byKey) this.keyAt = performance.now();
    const place = this.page.place();
    if (Math.hypot(place.x - this.from.x, place.y - this.from.y) < leastMove * surface.scale) return;
    const now = performance.now();
    this.from = place;
    this.movedAt = now;
    if (this.timer === undefined) this.pulse();
    if (byKey) {
      this.saidAt = now;
      return;
    }
    if (now - this.askedAt < askEvery) return;
    this.askedAt = now;
    void this.ask().then((text) => {
      if (text === null || text === '') return;
      // The end of the way is said at once.
      if (this.isLeading && performance.now() - this.saidAt < sayEvery) return;
      this.saidAt = performance.now();
      this.page.say(text, this.isLeading ? Importance.motion : Importance.answer);
    });
  }

  private async ask(): Promise<string | null> {
    const answer = await this.page.way();
    if (answer === null || this.name === null) return null;
    if (answer.x_m === null || answer.y_m === null) {
      const moving = this.keyAt + settling - performance.now();
      if (moving > 0) {
        await new Promise((resolve) => setTimeout(resolve, moving));
        return this.ask();
      }
      const { name } = this;
      this.stop();
      this.reached = name;
      this.feedback.sound.play(this.page.probe(), { what: 'name' });
      this.page.found();
    } else {
      this.target = { x: answer.x_m, y: answer.y_m };
      if (this.timer === undefined) this.pulse();
    }
    return answer.text;
  }

  /** One pulse, and the next one after a time that follows the distance. */
  private pulse(): void {
    clearTimeout(this.timer);
    this.timer = undefined;
    const surface = this.page.surface();
    if (this.target === null || surface === null || performance.now() - this.movedAt > patience) return;
    const { x, y } = this.page.place();
    const longer = Math.max(surface.sizeX, surface.sizeY);
    const away = { x: this.target.x - x, y: this.target.y - y };
    const half = { sizeX: longer / 2, sizeY: longer / 2 };
    this.feedback.sound.play(this.page.probe(), { what: 'find', frequency: findPitch((2 * away.y) / longer) }, directionOf(away, half));
    this.timer = setTimeout(() => this.pulse(), 1000 * findInterval(Math.hypot(away.x, away.y) / longer));
  }
}
