// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// One probe's sound, sample by sample: it runs in the audio worklet, and in tests.
import { FrictionNoise, type Grip } from './friction_noise';
import { HeightTone } from './height_tone';
import { ModalBank, type Body } from './modal_bank';
import { Smoothed } from './smoothed';

/** The sounds, in the order of the page's list. */
export const soundKinds = ['contact', 'slide', 'height', 'edge', 'name', 'find'] as const;
export type SoundKind = (typeof soundKinds)[number];
/** Amplitude of each sound: 0 ... 1. */
export type Levels = Record<SoundKind, number>;

export type Action =
  | { what: 'levels'; levels: Levels }
  /** The material under the probe. */
  | { what: 'material'; body: Body; grip: Grip }
  /** `strength`: 0 ... 1. */
  | { what: 'contact'; strength: number }
  /** Speed in m/s along the surface and force in N; without another one within `slideTime` the probe rests. */
  | { what: 'slide'; speed: number; force: number }
  /** Hz. */
  | { what: 'height'; frequency: number }
  | { what: 'edge' }
  | { what: 'name' }
  /** Hz. */
  | { what: 'find'; frequency: number }
  /** All sounds fade. */
  | { what: 'silence' };
/** `at`: the audio context's time (s); as soon as possible without it. */
export type Command = Action & { at?: number };

/** s. */
export const slideTime = 0.15;

const edgeBody: Body = { modes: [1568, 3140, 4710].map((frequency, i) => ({ frequency, decay: 0.02, gain: [0.7, 0.2, 0.1][i]! })), contactTime: 3e-4 };
const nameBody: Body = { modes: [659, 988, 1319].map((frequency, i) => ({ frequency, decay: 0.14, gain: [0.5, 0.3, 0.2][i]! })), contactTime: 8e-4 };
const findBody = (frequency: number): Body => ({ modes: [1, 2.76].map((factor, i) => ({ frequency: factor * frequency, decay: 0.05, gain: [0.8, 0.2][i]! })), contactTime: 6e-4 });
const usual: Levels = { contact: 1, slide: 1, height: 1, edge: 1, name: 1, find: 1 };
/** Amplitude of each sound at its full level, so that all are about equally loud. */
const full: Levels = { contact: 0.6, slide: 0.5, height: 0.18, edge: 0.4, name: 0.45, find: 0.4 };
/** An amplitude that can be heard: the onset of a contact is its first sample of this size. */
const onsetLevel = 1e-3;

export class Instrument {
  private readonly bodies: Record<'contact' | 'edge' | 'name' | 'find', ModalBank>;
  private readonly friction: FrictionNoise;
  private readonly tone: HeightTone;
  private readonly levels: Record<SoundKind, Smoothed>;
  /** In order of time. */
  private readonly waiting: Command[] = [];
  private slid = 0;
  /** A contact has begun and is not audible yet. */
  private struck = false;
  private onset: number | null = null;

  constructor(private readonly sampleRate: number) {
    const bank = () => new ModalBank(sampleRate);
    this.bodies = { contact: bank(), edge: bank(), name: bank(), find: bank() };
    this.bodies.edge.setBody(edgeBody);
    this.bodies.name.setBody(nameBody);
    this.friction = new FrictionNoise(sampleRate);
    this.tone = new HeightTone(sampleRate);
    const level = (kind: SoundKind) => [kind, new Smoothed(full[kind] * usual[kind], 0.015, sampleRate)] as const;
    this.levels = Object.fromEntries(soundKinds.map(level)) as Record<SoundKind, Smoothed>;
  }

  send(command: Command): void {
    const at = command.at ?? -Infinity;
    let place = this.waiting.length;
    while (place > 0 && (this.waiting[place - 1]!.at ?? -Infinity) > at) place -= 1;
    this.waiting.splice(place, 0, command);
  }

  /** Adds nothing, replaces `out`; `time`: of its first sample (s). */
  render(out: Float32Array, time: number): void {
    for (let i = 0; i < out.length; ++i) {
      while (this.waiting.length > 0 && (this.waiting[0]!.at ?? -Infinity) <= time + i / this.sampleRate) this.act(this.waiting.shift()!);
      out[i] = this.next(time + i / this.sampleRate);
    }
    for (const body of Object.values(this.bodies)) body.settle();
  }

  /** The time of the first audible sample of a contact since the last call (s); null if there was none. */
  takeOnset(): number | null {
    const { onset } = this;
    this.onset = null;
    return onset;
  }

  private next(time: number): number {
    const { levels, bodies } = this;
    this.slid += 1;
    if (this.slid === Math.round(slideTime * this.sampleRate)) this.friction.slide(0, 0);
    const contact = levels.contact.next() * bodies.contact.next();
    if (this.struck && Math.abs(contact) >= onsetLevel) {
      this.struck = false;
      this.onset = time;
    }
    return (
      contact +
      levels.slide.next() * this.friction.next() +
      levels.height.next() * this.tone.next() +
      levels.edge.next() * bodies.edge.next() +
      levels.name.next() * bodies.name.next() +
      levels.find.next() * bodies.find.next()
    );
  }

  private act(command: Command): void {
    switch (command.what) {
      case 'levels':
        for (const kind of soundKinds) this.levels[kind].target = full[kind] * command.levels[kind];
        return;
      case 'material':
        this.bodies.contact.setBody(command.body);
        return this.friction.setGrip(command.grip);
      case 'contact':
        this.struck = true;
        return this.bodies.contact.strike(command.strength);
      case 'slide':
        this.slid = 0;
        return this.friction.slide(command.speed, command.force);
      case 'height':
        return this.tone.play(command.frequency);
      case 'edge':
        return this.bodies.edge.strike(1);
      case 'name':
        return this.bodies.name.strike(1);
      case 'find':
        this.bodies.find.setBody(findBody(command.frequency));
        return this.bodies.find.strike(1);
      case 'silence':
        this.tone.stop();
        return this.friction.slide(0, 0);
    }
  }
}
