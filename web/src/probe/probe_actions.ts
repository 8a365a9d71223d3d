// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Probes come, are chosen and go: by key, by the panel, by fingers; and what is said of it.
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
  /** What was done, and what lies under the chosen probe. */
  chosenWords(what: string): Words;
  /** How many probes there are, where, and what each feels. */
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
    if (!own.choose(probe, this.probes.placeOf(own.chosen))) return this.page.say('There can be no probe of that number.', Importance.answer);
    const how = own.numbers.length > before ? ' put down' : '';
    this.page.say(this.page.chosenWords(`Probe ${probe + 1}${how}`), Importance.answer);
    this.changed();
  }
  add(): void {
    const probe = this.probes.own.free();
    if (probe !== null) this.choose(probe);
  }
  take(): void {
    const probe = this.probes.own.chosen;
    if (!this.probes.own.remove(probe)) return this.page.say('The first probe stays.', Importance.answer);
    this.lift(probe);
    this.page.say(`Probe ${probe + 1} taken away. The keys move probe 1.`, Importance.answer);
  }
  describeProbes(): void {
    this.page.say(this.page.allWords(), Importance.answer);
  }

  /** A finger has put a probe down; has lifted it; or finds no further one. */
  came(probe: number): void {
    this.page.say(`Probe ${probe + 1} touches.`, Importance.motion);
    this.changed();
  }
  left(probe: number): void {
    this.page.say(`Probe ${probe + 1} lifted.`, Importance.motion);
    this.lift(probe);
  }
  full(): void {
    this.page.say(`More than ${this.probes.own.numbers.length} probes cannot touch at once.`, Importance.news);
  }

  /** Shows the newest figures, not more often than they can be read. */
  show(): void {
    const now = performance.now();
    if (now - this.shownAt < figuresEvery) return;
    this.shownAt = now;
    this.panel.show(this.probes.states, this.page.surface()?.scale);
  }
  /** Nothing is known any more. */
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
