// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// How a material of the scene sounds when it is struck, and when the probe slides over it.
import type { Material } from '../../settings/materials';
import type { Grip } from './friction_noise';
import type { Body, Mode } from './modal_bank';

export type SoundingMaterial = Pick<Material, 'stiffness_N_per_m' | 'damping_Ns_per_m' | 'friction' | 'texture' | 'pitch_m' | 'height_m'>;

/** For a scene without materials. */
export const plain: SoundingMaterial = { stiffness_N_per_m: 500, damping_Ns_per_m: 0, friction: 0.3, texture: 'none', pitch_m: 2e-3, height_m: 1e-4 };

/** Frequencies of a bar with free ends, as multiples of the lowest (Rossing & Fletcher). */
const ratios = [1, 2.757, 5.404, 8.933, 13.34];
const usualStiffness = 500;
const within = (value: number, least: number, most: number) => Math.min(most, Math.max(least, value));

/** The lowest mode: as of a mass on a spring, it rises with the root of the stiffness (Hz). */
export const lowestMode = (stiffness_N_per_m: number) => within(330 * Math.sqrt(stiffness_N_per_m / usualStiffness), 90, 900);

/**
 * The internal friction, tan phi: the share of the energy that is lost in a radian of a vibration. Listeners tell materials
 * by it (Klatzky, Pai & Krotkov 2000): about 0.003 for metal, 0.03 for wood, 0.3 for rubber. Soft, damped and rough
 * materials lose more.
 */
export function lossOf({ stiffness_N_per_m, damping_Ns_per_m, friction }: SoundingMaterial): number {
  const soft = usualStiffness / Math.max(1, stiffness_N_per_m);
  return within(0.02 * soft * (1 + friction) * (1 + damping_Ns_per_m), 0.003, 0.3);
}

export function bodyOf(material: SoundingMaterial): Body {
  const lowest = lowestMode(material.stiffness_N_per_m);
  const loss = lossOf(material);
  const gains = ratios.map((ratio) => 1 / ratio);
  const sum = gains.reduce((a, b) => a + b);
  const modes: Mode[] = ratios.map((ratio, i) => ({
    frequency: lowest * ratio,
    decay: within(1 / (Math.PI * lowest * ratio * loss), 0.004, 0.5),
    gain: gains[i]! / sum,
  }));
  return { modes, contactTime: within(1e-3 * Math.sqrt(usualStiffness / Math.max(1, material.stiffness_N_per_m)), 3e-4, 4e-3) };
}

export function gripOf({ stiffness_N_per_m, friction, texture, pitch_m, height_m }: SoundingMaterial): Grip {
  return {
    roughness: within(0.3 + 0.7 * friction, 0.3, 1),
    brightness: within((stiffness_N_per_m / usualStiffness) ** 0.25, 0.5, 1.5),
    texture: { kind: texture, pitch: Math.max(1e-5, pitch_m), depth: height_m / (height_m + 3e-5) },
  };
}
