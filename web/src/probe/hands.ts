// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Which probe a pointer or the keys move. Keys and a pointer that is alone move the chosen probe; each further pointer at
// the same moment is a probe of its own, as long as it is down. Probe 0 is the hand and always there.
import { ProbeHand } from './probe';
import type { Place, Surface } from '../surface';

interface Held {
  probe: number;
  /** It came with its pointer and goes with it. */
  own: boolean;
}

export class Hands {
  private readonly hands = new Map<number, ProbeHand>([[0, new ProbeHand()]]);
  private readonly pointers = new Map<number, Held>();
  private chosenProbe = 0;
  private most = 1;
  private handIsHere = true;

  /** How many probes there can be, and whether this page moves the hand (else a device does). */
  set(most: number, handIsHere: boolean): void {
    this.most = most;
    this.handIsHere = handIsHere;
  }

  get chosen(): number {
    return this.chosenProbe;
  }
  /** Of those that this page moves, and the hand. */
  get numbers(): number[] {
    return [...this.hands.keys()].sort((a, b) => a - b);
  }
  get several(): boolean {
    return this.hands.size > 1;
  }
  at(probe: number): ProbeHand | undefined {
    return this.hands.get(probe);
  }
  get hand(): ProbeHand {
    return this.hands.get(this.chosenProbe)!;
  }
  movable(probe = this.chosenProbe): boolean {
    return probe !== 0 || this.handIsHere;
  }

  /** Chooses a probe, which is put down at `place` where it is not there yet; false if there can be none of that number. */
  choose(probe: number, place: Place): boolean {
    if (probe >= this.most) return false;
    if (!this.hands.has(probe)) this.hands.set(probe, new ProbeHand(place));
    this.chosenProbe = probe;
    return true;
  }

  /** The lowest number that is free; null if there is none. */
  free(): number | null {
    for (let probe = 1; probe < this.most; ++probe) if (!this.hands.has(probe)) return probe;
    return null;
  }

  /** False for the hand, which stays. */
  remove(probe: number): boolean {
    if (probe === 0 || !this.hands.delete(probe)) return false;
    if (this.chosenProbe === probe) this.chosenProbe = 0;
    for (const [pointer, held] of this.pointers) if (held.probe === probe) this.pointers.delete(pointer);
    return true;
  }

  /** A pointer goes down: the probe that it moves from now on, and whether it is a new one; null if there are enough. */
  press(pointer: number, place: Place): { probe: number; isNew: boolean } | null {
    if (this.movable() && !this.isHeld(this.chosenProbe)) {
      this.pointers.set(pointer, { probe: this.chosenProbe, own: false });
      return { probe: this.chosenProbe, isNew: false };
    }
    const probe = this.free();
    if (probe === null) return null;
    this.hands.set(probe, new ProbeHand(place));
    this.pointers.set(pointer, { probe, own: true });
    return { probe, isNew: true };
  }

  /** The probe that a pointer moves: its own, or, where it hovers, the chosen one if no other pointer holds it. */
  movedBy(pointer: number): number | null {
    const held = this.pointers.get(pointer);
    if (held) return held.probe;
    return this.movable() && this.pointers.size === 0 ? this.chosenProbe : null;
  }

  /** A pointer is up again: the probe that went with it; null if none did. */
  release(pointer: number): number | null {
    const held = this.pointers.get(pointer);
    this.pointers.delete(pointer);
    return held?.own && this.remove(held.probe) ? held.probe : null;
  }

  /** Moves all marbles on; the probes whose places have to be told. */
  advance(seconds: number, surface: Surface, exaggeration: number): number[] {
    return this.numbers.filter((probe) => this.movable(probe) && this.hands.get(probe)!.advance(seconds, surface, exaggeration));
  }

  private isHeld(probe: number): boolean {
    return [...this.pointers.values()].some((held) => held.probe === probe);
  }
}
