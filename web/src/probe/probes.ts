// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// All probes: this page's own, and the program's state of each.
import { t } from '../language';
import type { ProbeState, State } from '../generated/protocol';
import type { Place, Surface } from '../surface';
import type { ProbeView } from '../view/view';
import { PageProbes } from './page_probes';

/** Time after its own last move of a probe in which a page ignores other places of it (ms), since states are delayed. */
const ownMoveTime = 400;

export const forceOf = ({ fx_N, fy_N, fz_N }: ProbeState): [number, number, number] => [fx_N, fy_N, fz_N];
export const newtons = (state: ProbeState): number => Math.hypot(...forceOf(state));

export class Probes {
  readonly own = new PageProbes();
  /** The states, first probe first; empty if unknown. */
  states: readonly ProbeState[] = [];
  /** Whether the states are those of a recording: then this page moves none of them. */
  areReplayed = false;
  /** This page's number in the session. */
  page = 0;

  /** Takes the newest tick. Returns the probe that another page has started to move, if any. */
  receive(state: State, now: number): number | null {
    const before = this.states;
    this.states = state.probes;
    if (this.areReplayed) return null;
    let taken: number | null = null;
    for (const { probe, page, x_m, y_m } of state.probes) {
      const moved = this.own.at(probe);
      if (moved === undefined || !this.own.movable(probe) || page === this.page || now - moved.movedAt < ownMoveTime) continue;
      if (page === null) {
        // Nobody has moved it yet: this page's place applies.
        moved.resend();
        continue;
      }
      moved.adopt({ x: x_m, y: y_m });
      if (before.find((one) => one.probe === probe)?.page === this.page) taken = probe;
    }
    return taken;
  }
  forget(): void {
    this.states = [];
  }

  /** Whether this page moves the probe now. */
  moves(probe: number): boolean {
    return !this.areReplayed && this.own.movable(probe);
  }

  /** The numbers of this page's probes and of those that others move. */
  get numbers(): number[] {
    if (this.areReplayed) return this.states.map(({ probe }) => probe);
    return [...new Set([...this.own.numbers, ...this.states.map(({ probe }) => probe)])].sort((a, b) => a - b);
  }
  stateOf(probe: number): ProbeState | undefined {
    return this.states.find((state) => state.probe === probe);
  }
  get chosen(): ProbeState | undefined {
    return this.stateOf(this.own.chosen);
  }

  /** The place of a probe: this page's own, else the program's. */
  placeOf(probe: number): Place {
    const own = this.own.at(probe);
    const state = this.stateOf(probe);
    if (state && (own === undefined || !this.moves(probe))) return { x: state.x_m, y: state.y_m };
    return own?.place ?? { x: 0, y: 0 };
  }

  /** Adds the probe's number to a sentence if there are several. */
  named(words: string): string {
    return this.own.several ? t('Probe {probe}: {words}', { probe: this.own.chosen + 1, words }) : words;
  }

  /** The probes for drawing. */
  views(surface: Surface, heightFactor: number): ProbeView[] {
    return this.numbers.map((probe) => {
      const [place, state, own] = [this.placeOf(probe), this.stateOf(probe), this.own.at(probe)];
      const isOurs = own !== undefined && this.moves(probe);
      const z = isOurs ? surface.heightAt(place) * heightFactor + Math.max(0, -own.press) : Math.max(state?.z_m ?? 0, state?.surface_m ?? 0);
      return { ...place, z, force: state ? forceOf(state) : [0, 0, 0], number: probe + 1, chosen: probe === this.own.chosen };
    });
  }
}
