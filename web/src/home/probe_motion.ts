// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The motion of this page's probes: moved by keys, sent to the program, and sonified.
import { t } from '../language';
import type { FromPage, Scene } from '../generated/protocol';
import type { Finder } from '../names/finder';
import { pressScale } from '../probe/page_probe';
import type { Probes } from '../probe/probes';
import type { Walking } from '../probe/walking';
import { Importance, type Words } from '../sound/announcer';
import type { Feedback } from '../sound/feedback';
import type { Place, Surface } from '../surface';
import type { Move } from './keys';
import type { Narrator } from './narrator';

export interface MotionPage {
  scene(): Scene | null;
  surface(): Surface | null;
  connected(): boolean;
  heightFactor(): number;
  /** The name of the device that moves the first probe, if this page does not. */
  device(): string;
  say(words: Words | string, importance: Importance): void;
  send(message: FromPage): void;
  /** The device's middle is another one from now on. */
  /** Requests frames while something moves. */
  moves(): void;
  draw(): void;
}

/** Least milliseconds between two messages with the probes' places, since many fingers on a fast screen give many messages. */
const sendEvery = 12;
/** Metres that a device's probe moves, on a scene of 0.1 m, before its tone is played again: a hand at rest trembles by less. */
const leastHeard = 1e-4;

export class ProbeMotion {
  private sentAt = -Infinity;
  /** Where a device's probe was when it was last sonified. */
  private heardAt: Place = { x: NaN, y: NaN };

  constructor(
    private readonly probes: Probes,
    private readonly narrator: Narrator,
    private readonly walking: Walking,
    private readonly finder: Finder,
    private readonly feedback: Feedback,
    private readonly page: MotionPage,
  ) {}

  /** Moves by a key; the step is for a scene of 0.1 m and is scaled with the scene's size. */
  move(by: Move): void {
    const surface = this.page.surface();
    if (surface === null) return;
    const { own } = this.probes;
    if (!own.movable()) return this.page.say(t('The probe is moved by {device}.', { device: this.page.device() }), Importance.answer);
    // In the egocentric view arrows are relative to the explorer's heading, otherwise to the scene.
    const way = this.walking.inScene({ x: by.x * surface.scale, y: by.y * surface.scale });
    const free = own.current.step(way.x, way.y, by.press * pressScale(surface.scale), surface, performance.now());
    this.page.moves();
    if (by.press !== 0) return this.page.say(this.narrator.press(), Importance.motion);
    this.finder.moved(true);
    this.page.say(this.finder.isLeading ? this.finder.words(free ? '' : `${t('Rim of the scene.')} `) : this.narrator.step(free), Importance.motion);
  }

  /** Moves to the nearest surface, and says what is there. */
  toSurface(): void {
    const { own } = this.probes;
    if (!own.movable()) return this.page.say(t('The probe is moved by {device}.', { device: this.page.device() }), Importance.answer);
    this.page.say(async () => {
      const answer = await this.narrator.surface();
      if (answer === null) return null;
      if (answer.x_m !== null && answer.y_m !== null) own.current.jump({ x: answer.x_m, y: answer.y_m }, performance.now());
      this.page.moves();
      return answer.text;
    }, Importance.answer);
  }

  recentre(): void {
    const { own } = this.probes;
    if (own.isGuest && !own.movable()) return this.page.say(t('The probe is moved by {device}.', { device: this.page.device() }), Importance.answer);
    const scene = this.page.scene();
    own.current.jump(this.middle(), performance.now());
    this.walking.reset();
    if (own.chosen === 0) this.page.send({ type: 'recentre' });
    this.walking.sendPose();
    this.page.moves();
    const mayBeEmpty = scene?.kind.endsWith('field') ?? false;
    this.page.say(mayBeEmpty ? this.narrator.middle() : this.probes.named(t('In the middle.')), Importance.answer);
  }

  /** Brings one of this page's probes to the middle, without a word. */
  centre(probe: number): void {
    const { own } = this.probes;
    if (!own.movable(probe)) return;
    own.at(probe)?.jump(this.middle(), performance.now());
    this.page.moves();
  }

  /** Says where one of this page's probes rests, for a program that takes a silent page for a hand that left. */
  stay(probe: number): void {
    const own = this.probes.own.at(probe);
    // Not where another page moved it last: both would take it from each other.
    if (own === undefined || !this.page.connected() || !this.probes.moves(probe) || this.probes.stateOf(probe)?.page !== this.probes.page) return;
    this.page.send({ type: 'pointer', probe, x_m: own.place.x, y_m: own.place.y, press_m: own.press });
  }

  private middle(): Place {
    const scene = this.page.scene();
    return { x: scene?.middle_x_m ?? 0, y: scene?.middle_y_m ?? 0 };
  }

  /** Advances the marbles and sends their places; true while they move. */
  advance(now: number, passed: number | null): boolean {
    const surface = this.page.surface();
    if (surface === null || !this.page.connected()) return false;
    const { own } = this.probes;
    if (own.several && now - this.sentAt < sendEvery) return true;
    this.sentAt = now;
    const moved = own.advance(Math.min(0.1, (passed ?? 16) / 1000), surface, this.page.heightFactor());
    for (const probe of moved) {
      const { place, press: press_m } = own.at(probe)!;
      this.page.send({ type: 'pointer', probe, x_m: place.x, y_m: place.y, press_m });
      this.feedback.moved(probe, place, surface, this.page.heightFactor());
    }
    if (moved.length > 0) this.page.draw();
    return moved.length > 0;
  }

  /** Sonifies the program's report of the probes at its time `t_s`. */
  hear(surface: Surface, t_s: number): void {
    for (const one of this.probes.states) this.feedback.reported(one, surface, t_s);
    const { own } = this.probes;
    if (!this.probes.moves(0) && !(own.isGuest && own.movable())) this.hearDevice(this.probes.placeOf(0), surface);
    this.feedback.removeProbesExcept(this.probes.numbers);
  }

  /** States also come while the device rests: then it is silent. */
  private hearDevice(place: Place, surface: Surface): void {
    const { x, y } = this.heardAt;
    if (Math.hypot(place.x - x, place.y - y) < leastHeard * surface.scale) return;
    this.heardAt = place;
    this.feedback.moved(0, place, surface, this.page.heightFactor());
  }

  /** Plays the tone of the selected probe's place, as an example. */
  sample(): void {
    const surface = this.page.surface();
    if (surface !== null) this.feedback.moved(this.probes.own.chosen, this.narrator.place(), surface, this.page.heightFactor());
  }
}
