// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Which probe a pointer or the keys move. Keys and a single pointer move the selected probe; each additional simultaneous
// pointer has its own probe while it is down. Probe 0 always exists.
import { PageProbe } from './page_probe';
import type { Place, Surface } from '../surface';

interface Held {
  probe: number;
  /** It was added with its pointer and is removed with it. */
  own: boolean;
}

export class PageProbes {
  private readonly probes = new Map<number, PageProbe>([[0, new PageProbe()]]);
  private readonly pointers = new Map<number, Held>();
  private chosenProbe = 0;
  private most = 1;
  private movesFirst = true;
  private hands = 1;
  /** Of a guest's page: the only probe that it moves, or null for none. */
  private only: number | null | undefined;
  private scale = 1;

  /**
   * How many probes there can be, whether this page moves the first one (else a device does), and how many of the first
   * ones are hands: those after the first are always moved by devices.
   */
  set(most: number, movesFirst: boolean, hands = 1): void {
    this.most = most;
    this.movesFirst = movesFirst;
    this.hands = hands;
    for (let hand = 1; hand < hands; ++hand) if (!this.probes.has(hand)) this.put(hand, { x: 0, y: 0 });
  }

  /** Makes this a guest's page, which moves this probe alone; null: none. It is sent again, since it was lifted while the page was away. */
  setGuest(probe: number | null): void {
    if (probe !== null) {
      for (const other of this.numbers) if (other !== probe) this.probes.delete(other);
      if (!this.probes.has(probe)) this.put(probe, { x: 0, y: 0 });
      this.chosenProbe = probe;
    }
    this.only = probe;
    this.comeBack();
  }
  get isGuest(): boolean {
    return this.only !== undefined;
  }
  /** The page of a guest is visible again. */
  comeBack(): void {
    if (this.isGuest && this.movable()) this.current.resend();
  }

  /** The scale of the touched surface. */
  setScale(scale: number): void {
    this.scale = scale;
    for (const probe of this.probes.values()) probe.setScale(scale);
  }

  get chosen(): number {
    return this.chosenProbe;
  }
  /** The numbers of this page's probes and the hands. */
  get numbers(): number[] {
    return [...this.probes.keys()].sort((a, b) => a - b);
  }
  /** Whether one of this page's probes is moving. */
  get pending(): boolean {
    return this.numbers.some((probe) => this.movable(probe) && this.probes.get(probe)!.pending);
  }
  get several(): boolean {
    return this.probes.size > 1;
  }
  at(probe: number): PageProbe | undefined {
    return this.probes.get(probe);
  }
  get current(): PageProbe {
    return this.probes.get(this.chosenProbe)!;
  }
  movable(probe = this.chosenProbe): boolean {
    if (this.isGuest) return probe === this.only;
    return probe >= this.hands || (probe === 0 && this.movesFirst);
  }

  /** Selects a probe, which is added at `place` if it does not exist; false for an invalid number. */
  choose(probe: number, place: Place): boolean {
    if (probe >= this.most || (this.isGuest && !this.probes.has(probe))) return false;
    if (!this.probes.has(probe)) this.put(probe, place);
    this.chosenProbe = probe;
    return true;
  }

  /** The lowest free number; null if there is none. */
  free(): number | null {
    if (this.isGuest) return null;
    for (let probe = 1; probe < this.most; ++probe) if (!this.probes.has(probe)) return probe;
    return null;
  }

  /** False for the hands, which cannot be removed. */
  remove(probe: number): boolean {
    if (this.isGuest || probe < this.hands || !this.probes.delete(probe)) return false;
    if (this.chosenProbe === probe) this.chosenProbe = 0;
    for (const [pointer, held] of this.pointers) if (held.probe === probe) this.pointers.delete(pointer);
    return true;
  }

  /** A pointer goes down: the probe that it moves, and whether it is new; null if there is none left. */
  press(pointer: number, place: Place): { probe: number; isNew: boolean } | null {
    if (this.movable() && !this.isHeld(this.chosenProbe)) {
      this.pointers.set(pointer, { probe: this.chosenProbe, own: false });
      return { probe: this.chosenProbe, isNew: false };
    }
    const probe = this.free();
    if (probe === null) return null;
    this.put(probe, place);
    this.pointers.set(pointer, { probe, own: true });
    return { probe, isNew: true };
  }

  /** The probe that a pointer moves: its own, or for a hovering pointer the selected one unless another pointer holds it. */
  movedBy(pointer: number): number | null {
    const held = this.pointers.get(pointer);
    if (held) return held.probe;
    return this.movable() && this.pointers.size === 0 ? this.chosenProbe : null;
  }

  /** A pointer goes up: the probe that was removed with it; null if none was. */
  release(pointer: number): number | null {
    const held = this.pointers.get(pointer);
    this.pointers.delete(pointer);
    return held?.own && this.remove(held.probe) ? held.probe : null;
  }

  /** Advances all marbles; returns the probes whose places must be sent. */
  advance(seconds: number, surface: Surface, heightFactor: number): number[] {
    return this.numbers.filter((probe) => this.movable(probe) && this.probes.get(probe)!.advance(seconds, surface, heightFactor));
  }

  private put(probe: number, place: Place): void {
    const added = new PageProbe(place);
    added.setScale(this.scale);
    added.resend();
    this.probes.set(probe, added);
  }

  private isHeld(probe: number): boolean {
    return [...this.pointers.values()].some((held) => held.probe === probe);
  }
}
