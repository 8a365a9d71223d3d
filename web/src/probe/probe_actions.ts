// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Adding, selecting and removing probes by key, panel and fingers, with spoken messages.
import { t } from '../language';
import { Importance, noScene, type Words } from '../sound/announcer';
import type { FromPage } from '../generated/protocol';
import type { Probes } from './probes';
import { ProbesPanel, type ProbesTarget } from './probes_panel';
import { figuresEvery } from '../figures';
import type { Surface } from '../surface';

export interface ProbesPage {
  surface(): Surface | null;
  say(words: Words | string, importance: Importance): void;
  send(message: FromPage): void;
  /** Says what was done, and the selected probe's place. */
  chosenWords(what: string): Words;
  /** Says the number of probes, their places and forces. */
  allWords(): Words;
  draw(): void;
}

export class ProbeActions implements ProbesTarget {
  private readonly panel = new ProbesPanel(this);
  private shownAt = -Infinity;

  constructor(
    private readonly probes: Probes,
    private readonly page: ProbesPage,
  ) {}

  choose(probe: number): void {
    const { own } = this.probes;
    const before = own.numbers.length;
    if (this.page.surface() === null) return this.page.say(noScene, Importance.answer);
    if (!own.choose(probe, this.probes.placeOf(own.chosen))) return this.page.say(t('There is no probe of that number.'), Importance.answer);
    this.page.say(this.page.chosenWords(own.numbers.length > before ? t('Probe {probe} added', { probe: probe + 1 }) : t('Probe {probe}', { probe: probe + 1 })), Importance.answer);
    this.changed();
  }
  add(): void {
    const probe = this.probes.own.free();
    if (probe !== null) this.choose(probe);
  }
  take(): void {
    const probe = this.probes.own.chosen;
    if (!this.probes.own.remove(probe)) {
      const words = probe === 0 || this.probes.own.isGuest ? t('The first probe cannot be removed.') : t('A device moves this probe: it cannot be removed.');
      return this.page.say(words, Importance.answer);
    }
    this.lift(probe);
    this.page.say(t('Probe {probe} removed. The keys move probe 1.', { probe: probe + 1 }), Importance.answer);
  }
  describeProbes(): void {
    this.page.say(this.page.allWords(), Importance.answer);
  }

  /** A finger has added a probe, has lifted it, or found none left. */
  came(probe: number): void {
    this.page.say(t('Probe {probe} touches.', { probe: probe + 1 }), Importance.motion);
    this.changed();
  }
  left(probe: number): void {
    this.page.say(t('Probe {probe} lifted.', { probe: probe + 1 }), Importance.motion);
    this.lift(probe);
  }
  full(): void {
    const { own } = this.probes;
    if (own.isGuest) return this.page.say(own.movable() ? t('You touch with one probe.') : t('You look: others move the probes.'), Importance.answer);
    this.page.say(t('More than {count} probes cannot touch at once.', { count: this.probes.own.numbers.length }), Importance.news);
  }

  /** Shows the newest figures at a readable rate. */
  show(): void {
    const now = performance.now();
    if (now - this.shownAt < figuresEvery) return;
    this.shownAt = now;
    this.panel.show(this.probes.states, this.page.surface()?.scale);
  }
  /** Clears all figures. */
  blank(): void {
    this.probes.forget();
    this.panel.show([]);
  }
  changed(): void {
    const { own } = this.probes;
    this.panel.offer(own.numbers, own.chosen, own.free() !== null);
    this.page.draw();
  }

  private lift(probe: number): void {
    this.page.send({ type: 'lift', probe });
    this.changed();
  }
}
