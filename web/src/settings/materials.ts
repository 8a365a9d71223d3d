// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A scene's materials as the page keeps them: one object a label, made of the program's lists.
import type { Edit, Materials } from '../generated/protocol';

/** What an edit wishes for one label, and its name. */
export interface Material extends Omit<Edit, 'type' | 'serial' | 'label'> {
  name: string;
}

/** The name that the program gives a material which has none of its own. */
const unnamed = 'default';

export function materialsOf(lists: Materials): Material[] {
  const at = (list: number[], label: number) => list[label] ?? 0;
  return lists.names.map((name, label) => ({
    name: name === unnamed || name === '' ? (lists.names.length === 1 ? 'the surface' : `region ${label + 1}`) : name,
    stiffness_N_per_m: at(lists.stiffness_N_per_m, label),
    damping_Ns_per_m: at(lists.damping_Ns_per_m, label),
    friction: at(lists.friction, label),
    stickiness: at(lists.stickiness, label),
    texture: lists.textures[label] ?? 'none',
    pitch_m: at(lists.pitch_m, label),
    height_m: at(lists.height_m, label),
    angle_deg: at(lists.angle_deg, label),
  }));
}

export function sameMaterial(a: Material, b: Material): boolean {
  return (Object.keys(a) as (keyof Material)[]).every((key) => a[key] === b[key]);
}
