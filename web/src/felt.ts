// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What each probe feels, taken out of a state; numbers count from 0, the hand, and are said from 1.
import type { State } from './generated/protocol';

export interface Felt {
  probe: number;
  x_m: number;
  y_m: number;
  z_m: number;
  surface_m: number;
  force: [number, number, number];
  contact: boolean;
  label: number;
}

/** The hand first, then the further probes that are there. */
export function feltOf(state: State): Felt[] {
  const { x_m, y_m, z_m, surface_m, fx_N, fy_N, fz_N, contact, label } = state;
  const hand: Felt = { probe: 0, x_m, y_m, z_m, surface_m, force: [fx_N, fy_N, fz_N], contact, label };
  const further = state.further.map((probe, k): Felt => {
    const of = (list: number[]) => list[k] ?? 0;
    return {
      probe,
      x_m: of(state.further_x_m),
      y_m: of(state.further_y_m),
      z_m: of(state.further_z_m),
      surface_m: of(state.further_surface_m),
      force: [of(state.further_fx_N), of(state.further_fy_N), of(state.further_fz_N)],
      contact: of(state.further_contact) > 0,
      label: of(state.further_label),
    };
  });
  return [hand, ...further];
}

export const newtons = ({ force }: Felt): number => Math.hypot(...force);
