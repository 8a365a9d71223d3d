// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A scene's materials: one flat object per label, so that each value has its own slider and its own undo.
import { t } from '../language';
import type { MaterialEdit, Materials, Texture, Material as ProgramMaterial } from '../generated/protocol';

export interface Material extends Omit<ProgramMaterial, 'texture'>, Omit<Texture, 'kind'> {
  name: string;
  texture: string;
}

export function materialsOf({ materials }: Materials): Material[] {
  return materials.map(({ name, material: { texture, ...values } }, label) => {
    const { kind, ...shape } = texture;
    return { ...values, ...shape, texture: kind, name: name ?? (materials.length === 1 ? t('the surface') : t('region {label}', { label: label + 1 })) };
  });
}

/** The values of `to` that differ from those of `from`; null if none does. */
export function editOf(from: Material, to: Material): MaterialEdit | null {
  const changed = <K extends keyof Material>(key: K): Material[K] | null => (from[key] === to[key] ? null : to[key]);
  const textureKeys = ['texture', 'pitch_m', 'height_m', 'angle_deg'] as const;
  const edit: MaterialEdit = {
    stiffness_N_per_m: changed('stiffness_N_per_m'),
    damping_Ns_per_m: changed('damping_Ns_per_m'),
    friction: changed('friction'),
    stickiness: changed('stickiness'),
    texture: textureKeys.every((key) => from[key] === to[key])
      ? null
      : { kind: to.texture, pitch_m: to.pitch_m, height_m: to.height_m, angle_deg: to.angle_deg },
  };
  return Object.values(edit).every((value) => value === null) ? null : edit;
}
