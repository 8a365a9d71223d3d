// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The interface of a view of the scene, in 3D (view3d.ts) or flat (view_flat.ts).
import type { PictureFrame } from '../codec';
import { defaults, type Preferences } from '../settings/preferences';
import type { Place, Surface } from '../surface';
import type { CameraPose } from './camera';
import type { Fit } from './depth/fit';
import type { ScreenPoint } from './depth/frustum';
import type { Registration } from './depth/registration';
import type { Headset } from './headset/headset';
import type { SecondView } from './second_view';
import type { Speed } from './pace';

export interface ProbeView extends Place {
  z: number;
  force: [number, number, number];
  /** Counted from 1. */
  number: number;
  /** Whether it is the selected one. */
  chosen: boolean;
}

/** The preferences that views follow. */
export type Look = Pick<
  Preferences,
  'surface' | 'tilt' | 'depthMode' | 'eyeDistance' | 'screenDistance' | 'depthBefore' | 'depthShare' | 'depthComfort' | 'secondView' | 'swapEyes' | 'pixelSize' | 'headsetSize'
>;
export const plainLook: Look = defaults;

export interface View {
  readonly canvas: HTMLCanvasElement;
  /** `second`: what the right eye sees instead of the picture, where the view is for two eyes. */
  show(surface: Surface, picture: PictureFrame | null, second?: SecondView | null): void;
  /** Sets the height factor and the look of the surface and the view. */
  set(heightFactor: number, look: Look): void;
  /** How the scene is shown on the screen in a depth mode; null: as a usual picture. */
  readonly fit: Fit | null;
  /** Null: a headset cannot show it. */
  readonly headset: Headset | null;
  /** Sets how far the head has moved from its resting place (depth/head.ts). */
  head(moved: ScreenPoint): void;
  /** Draws the scene in depth modes where the hand feels it (depth/registration.ts); null: in the middle of the picture. */
  register(registration: Registration | null): void;
  /** Sets all probes; numbers are shown if there are several. True if the view has changed. */
  probes(probes: readonly ProbeView[]): boolean;
  /** Sets a line on the surface; empty for none. */
  line(points: readonly Place[]): void;
  /** The place on the surface at a point of the canvas (CSS pixels from its upper left corner); null if there is none. */
  placeAt(left: number, top: number): Place | null;
  aim(pose: CameraPose): void;
  /** Metres per CSS pixel on the surface in the middle of the picture. */
  metresPerPixel(): number;
  resize(): void;
  /** Draws if anything has changed; `waited`: milliseconds from the request of the frame to its beginning. */
  draw(waited: number): Speed;
  dispose(): void;
}

/** Whether two lists of probes look equal: within 0.01 mm and 0.01 N. */
export function lookAlike(some: readonly ProbeView[], others: readonly ProbeView[]): boolean {
  const near = (p: number, q: number, limit: number) => Math.abs(p - q) < limit;
  const alike = (a: ProbeView, b: ProbeView) =>
    a.number === b.number && a.chosen === b.chosen && near(a.x, b.x, 1e-5) && near(a.y, b.y, 1e-5) && near(a.z, b.z, 1e-5) &&
    a.force.every((f, i) => near(f, b.force[i]!, 0.01));
  return some.length === others.length && some.every((probe, k) => alike(probe, others[k]!));
}

/** The colours of the style sheet that pictures use. */
export function themeColours(element: HTMLElement): { stage: string; clay: string; marble: string; force: string } {
  const style = getComputedStyle(element);
  const of = (name: string) => style.getPropertyValue(name).trim();
  return { stage: of('--stage'), clay: of('--clay'), marble: of('--marble'), force: of('--force') };
}
