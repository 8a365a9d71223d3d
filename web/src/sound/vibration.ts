// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Vibration of the phone and of gamepads: what is played when (docs/page.md lists the patterns). Motors are slow, so
// patterns carry events and the density of a texture, not its form.

import { t } from '../language';

/** One effect of a gamepad's two motors. */
export interface Rumble {
  /** ms. */
  duration: number;
  /** Of the slow motor, 0 ... 1. */
  strong: number;
  /** Of the fast motor, 0 ... 1. */
  weak: number;
}

/** The motors that a page reaches; tests replace them by a list of the calls. */
export interface Motors {
  /** Lengths in ms: on, off, on, ... False if the phone has refused; null if it has no vibration for pages. */
  phone(pattern: readonly number[]): boolean | null;
  /** After the first call the browser polls gamepads until the page is closed. */
  pads(rumble: Rumble): void;
  /** Those of a headset, which the browser reads anyway. */
  held(pads: readonly Gamepad[], rumble: Rumble): void;
}

/** What is said, each once. */
export const vibrationSentences = {
  none: t('This device does not vibrate for pages: sound tells contact and edges.'),
  refused: t('Vibration is refused by this device or its browser: sound tells contact and edges.'),
};

/** A pulse of this length can just be felt on a phone (ms). */
const shortest = 8;
/** Pulses for each second that a phone's motor can still separate. */
const fastest = 14;
/** How long a pattern for a texture lasts (ms); motion renews it. */
const textureTime = 250;
/** A gamepad's effect is not felt below this length (ms). */
const leastRumble = 40;

const round = (value: number) => Math.round(value);

/** A contact: one pulse, longer for a harder one; `strength` 0 ... 1. */
export const contactPattern = (strength: number): number[] => [round(12 + 28 * strength)];
/** An edge: two short pulses. */
export const edgePattern = (): number[] => [10, 30, 10];
/** A texture: as many pulses as forms pass in the time; `rate`: forms per second. Above what a motor separates, pulses get longer. Empty: too few to be felt as a texture. */
export function texturePattern(rate: number): number[] {
  if (!(rate >= 1000 / textureTime)) return [];
  const pulses = Math.min(rate, fastest);
  const period = 1000 / pulses;
  const on = Math.min(0.6 * period, shortest * Math.max(1, Math.sqrt(rate / fastest)));
  return Array.from({ length: Math.floor(textureTime / period) }, () => [round(on), round(period - on)]).flat().slice(0, -1);
}

const sum = (pattern: readonly number[]) => pattern.reduce((total, part) => total + part, 0);

export class Vibrator {
  private phone = false;
  private gamepads = false;
  private held: (() => readonly Gamepad[]) | null = null;
  /** When the running pattern ends (ms): a texture waits for it, an event replaces it. */
  private busyUntil = -Infinity;
  private readonly told = new Set<string>();

  constructor(
    private readonly motors: Motors,
    private readonly tell: (sentence: string) => void,
  ) {}

  set(phone: boolean, gamepads: boolean): void {
    this.phone = phone;
    this.gamepads = gamepads;
  }

  /** Also the controllers in the hands vibrate, as long as vibration is on; null: there are none. */
  hold(pads: (() => readonly Gamepad[]) | null): void {
    this.held = pads;
  }

  contact(strength: number, now: number): void {
    this.play(contactPattern(strength), { duration: leastRumble + 40 * strength, strong: strength, weak: 0.5 * strength }, now);
  }
  edge(now: number): void {
    this.play(edgePattern(), { duration: leastRumble, strong: 0, weak: 0.6 }, now);
  }
  /** Motion over a texture: `rate` forms per second, `depth` 0 ... 1. */
  texture(rate: number, depth: number, now: number): void {
    if (now < this.busyUntil) return;
    const pattern = texturePattern(rate);
    if (pattern.length > 0) this.play(pattern, { duration: textureTime, strong: 0, weak: 0.4 * depth }, now);
  }

  private play(pattern: readonly number[], rumble: Rumble, now: number): void {
    this.busyUntil = now + sum(pattern);
    if (this.gamepads) this.motors.pads(rumble);
    if (!this.phone) return;
    // A headset is no phone in the hand.
    if (this.held !== null) return this.motors.held(this.held(), rumble);
    const answer = this.motors.phone(pattern);
    if (answer === true) return;
    const which = answer === null ? 'none' : 'refused';
    if (!this.told.has(which)) this.tell(vibrationSentences[which]);
    this.told.add(which);
  }
}

/** The browser's. */
export const browserMotors: Motors = {
  phone: (pattern) => {
    // A computer without a motor lacks nothing: iOS does.
    if (typeof navigator.vibrate !== 'function') return typeof matchMedia === 'function' && matchMedia('(pointer: coarse)').matches ? null : true;
    // Browsers refuse vibration, with a warning, before the first user action.
    if (navigator.userActivation?.hasBeenActive === false) return true;
    return navigator.vibrate([...pattern]);
  },
  pads: (rumble) => shake(connectedPads(), rumble),
  held: (pads, rumble) => shake(pads, rumble),
};

function shake(pads: readonly Pad[], { duration, strong, weak }: Rumble): void {
  for (const pad of pads) {
    // Controllers of headsets, Firefox and some joysticks have single motors.
    const single = pad.hapticActuators ?? [];
    for (const motor of single) void motor.pulse(Math.max(strong, weak), duration).catch(() => undefined);
    if (single.length > 0 || !pad.vibrationActuator) continue;
    void pad.vibrationActuator.playEffect('dual-rumble', { duration, strongMagnitude: strong, weakMagnitude: weak }).catch(() => undefined);
  }
}

type Pad = Omit<Gamepad, 'vibrationActuator'> & {
  vibrationActuator?: GamepadHapticActuator | null;
  hapticActuators?: readonly { pulse(value: number, duration: number): Promise<unknown> }[];
};

function connectedPads(): Pad[] {
  return typeof navigator.getGamepads === 'function' ? navigator.getGamepads().filter((pad) => pad !== null) : [];
}
