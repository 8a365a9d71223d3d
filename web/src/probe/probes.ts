// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// All probes as the page knows them: those that it moves itself, and what the program says that each feels.
import { probeWords } from '../sound/describe';
import { feltOf, newtons, type Felt } from '../felt';
import type { State } from '../generated/protocol';
import { PageProbes } from './page_probes';
import type { Place, Surface } from '../surface';
import type { Probe } from '../view/view';

export class Probes {
  readonly own = new PageProbes();
  /** The first probe's first; empty where nothing is known. */
  felt: readonly Felt[] = [];

  receive(state: State): void {
    this.felt = feltOf(state);
  }
  forget(): void {
    this.felt = [];
  }

  /** This page's and those that others move. */
  get numbers(): number[] {
    return [...new Set([...this.own.numbers, ...this.felt.map(({ probe }) => probe)])].sort((a, b) => a - b);
  }
  stateOf(probe: number): Felt | undefined {
    return this.felt.find((felt) => felt.probe === probe);
  }
  get chosen(): Felt | undefined {
    return this.stateOf(this.own.chosen);
  }

  /** Of a probe that this page moves where it has it, else where the program has it. */
  placeOf(probe: number): Place {
    const own = this.own.at(probe);
    const felt = this.stateOf(probe);
    if (felt && (own === undefined || !this.own.movable(probe))) return { x: felt.x_m, y: felt.y_m };
    return own?.place ?? { x: 0, y: 0 };
  }

  /** Says whose words these are once there are several. */
  named(words: string): string {
    return this.own.several ? `Probe ${this.own.chosen + 1}: ${words}` : words;
  }

  /** How many there are, where, and what each feels. */
  words(surface: Surface, labelOf: (felt: Felt) => string): string {
    const each = this.felt.map((felt) => `Probe ${felt.probe + 1}: ${probeWords(this.placeOf(felt.probe), felt.surface_m, newtons(felt), labelOf(felt), surface)}.`);
    const count = each.length === 1 ? 'One probe.' : `${each.length} probes, the keys move probe ${this.own.chosen + 1}.`;
    return `${count} ${each.join(' ')}`;
  }

  /** As they are drawn. */
  views(surface: Surface, exaggeration: number): Probe[] {
    return this.numbers.map((probe) => {
      const [place, felt, own] = [this.placeOf(probe), this.stateOf(probe), this.own.at(probe)];
      const isOurs = own !== undefined && this.own.movable(probe);
      const z = isOurs ? surface.heightAt(place) * exaggeration + Math.max(0, -own.press) : Math.max(felt?.z_m ?? 0, felt?.surface_m ?? 0);
      return { ...place, z, force: felt?.force ?? [0, 0, 0], number: probe + 1, chosen: probe === this.own.chosen };
    });
  }
}
