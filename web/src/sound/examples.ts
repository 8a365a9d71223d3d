// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The examples of the page's list of sounds: each sound alone, with its vibration.
import { t } from '../language';
import type { Feedback } from './feedback';
import { soundKinds, type Action, type SoundKind } from './instrument/instrument';
import { bodyOf, gripOf, type SoundingMaterial } from './instrument/material_sound';
import { directionOf, findPitch, pitchOf, type Direction } from './sonify';

/** What is played at which time (s) from the beginning, and from where. */
export interface Step {
  at: number;
  action: Action;
  from: Direction;
}

const square = { sizeX: 2, sizeY: 2 };
/** `side`: -1 (left) ... 1 (right). */
const fromSide = (side: number) => directionOf({ x: side, y: 0 }, square);
/** From 0 to 1 in this many steps. */
const ramp = (steps: number) => Array.from({ length: steps }, (_, i) => i / (steps - 1));

export function exampleOf(kind: SoundKind, material: SoundingMaterial): Step[] {
  const begin: Step = { at: 0, action: { what: 'material', body: bodyOf(material), grip: gripOf(material) }, from: fromSide(0) };
  switch (kind) {
    case 'contact':
      // Gentle, then hard.
      return [begin, ...[0.3, 1].map((strength, i) => ({ at: 0.05 + 0.5 * i, action: { what: 'contact' as const, strength }, from: fromSide(0) }))];
    case 'slide':
      // From left to right, from slow to fast.
      return [begin, ...ramp(30).map((part) => ({ at: 0.05 + 1.5 * part, action: { what: 'slide' as const, speed: 0.01 + 0.15 * part, force: 1 }, from: fromSide(2 * part - 1) }))];
    case 'height':
      // From the lowest to the highest place.
      return ramp(30).map((part) => ({ at: 0.05 + 1.2 * part, action: { what: 'height' as const, frequency: pitchOf(part, 0, 1) }, from: fromSide(0) }));
    case 'edge':
      return [-0.6, 0.6].map((side, i) => ({ at: 0.05 + 0.35 * i, action: { what: 'edge' as const }, from: fromSide(side) }));
    case 'find':
      // Slow and from the side, then quick and from ahead; at last from above.
      return [-1, -0.6, -0.3, 0].map((side, i) => ({ at: 0.05 + [0, 0.7, 1.2, 1.5][i]!, action: { what: 'find' as const, frequency: findPitch(i === 3 ? 0.5 : 0) }, from: fromSide(side) }));
    case 'name':
      return [-1, 0, 1].map((side, i) => ({ at: 0.05 + 0.6 * i, action: { what: 'name' as const }, from: fromSide(side) }));
  }
}

/** The examples' own voice. */
const exampleVoice = -1;

/** Plays an example, once audio runs. `probe`: whose material it has. */
export async function playExample(kind: SoundKind, feedback: Feedback, probe: number): Promise<void> {
  const { sound, vibrator } = feedback;
  const material = feedback.materialUnder(probe);
  const now = performance.now();
  if (kind === 'contact') vibrator.contact(1, now);
  if (kind === 'edge') vibrator.edge(now);
  if (kind === 'slide' && material.texture !== 'none') vibrator.texture(0.08 / material.pitch_m, gripOf(material).texture.depth, now);
  await sound.wake();
  const begin = sound.now;
  for (const { at, action, from } of exampleOf(kind, material)) sound.play(exampleVoice, { ...action, at: begin + at }, from);
}

/** By the id of its button: plays the example of each sound, or says why it is silent. */
export function exampleActions(feedback: Feedback, probe: () => number, say: (words: string) => void): Record<string, () => void> {
  const tryOne = (kind: SoundKind) => {
    if (!feedback.sound.isOn) say(t('Sound is off.'));
    void playExample(kind, feedback, probe());
  };
  return Object.fromEntries(soundKinds.map((kind) => [`try-${kind}`, () => tryOne(kind)]));
}
