// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// All probes as the page knows them: those that it moves itself, and what the program says of each.
import type { ProbeState, State } from '../generated/protocol';
import type { Place, Surface } from '../surface';
import type { ProbeView } from '../view/view';
import { PageProbes } from './page_probes';

/** So long after its own last move of a probe a page ignores where others have it (ms): their answers are on the way. */
const ownMoveTime = 400;

export const forceOf = ({ fx_N, fy_N, fz_N }: ProbeState): [number, number, number] => [fx_N, fy_N, fz_N];
export const newtons = (state: ProbeState): number => Math.hypot(...forceOf(state));

export class Probes {
  readonly own = new PageProbes();
  /** The first probe first; empty while nothing is known. */
  states: readonly ProbeState[] = [];
  /** This page's number in the session. */
  page = 0;

  /** Takes the newest tick. Returns the probe that another page has begun to move, if there is one. */
  receive(state: State, now: number): number | null {
    const before = this.states;
    this.states = state.probes;
    let taken: number | null = null;
    for (const { probe, page, x_m, y_m } of state.probes) {
      const moved = this.own.at(probe);
      if (moved === undefined || !this.own.movable(probe) || page === this.page || now - moved.movedAt < ownMoveTime) continue;
      if (page === null) {
        // Nobody has moved it yet: it is where this page has it.
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

  /** This page's and those that others move. */
  get numbers(): number[] {
    return [...new Set([...this.own.numbers, ...this.states.map(({ probe }) => probe)])].sort((a, b) => a - b);
  }
  stateOf(probe: number): ProbeState | undefined {
    return this.states.find((state) => state.probe === probe);
  }
  get chosen(): ProbeState | undefined {
    return this.stateOf(this.own.chosen);
  }

  /** Of a probe that this page moves where it has it, else where the program has it. */
  placeOf(probe: number): Place {
    const own = this.own.at(probe);
    const state = this.stateOf(probe);
    if (state && (own === undefined || !this.own.movable(probe))) return { x: state.x_m, y: state.y_m };
    return own?.place ?? { x: 0, y: 0 };
  }

  /** Says which probe these words are about once there are several. */
  named(words: string): string {
    return this.own.several ? `Probe ${this.own.chosen + 1}: ${words}` : words;
  }

  /** As they are drawn. */
  views(surface: Surface, exaggeration: number): ProbeView[] {
    return this.numbers.map((probe) => {
      const [place, state, own] = [this.placeOf(probe), this.stateOf(probe), this.own.at(probe)];
      const isOurs = own !== undefined && this.own.movable(probe);
      const z = isOurs ? surface.heightAt(place) * exaggeration + Math.max(0, -own.press) : Math.max(state?.z_m ?? 0, state?.surface_m ?? 0);
      return { ...place, z, force: state ? forceOf(state) : [0, 0, 0], number: probe + 1, chosen: probe === this.own.chosen };
    });
  }
}
