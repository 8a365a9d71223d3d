// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The camera's pose: rotation about the vertical axis, zoom and shift. The tilt is a setting.
import { t } from '../language';
import type { Place, Surface } from '../surface';
import { wayWords } from '../way_words';

export const leastZoom = 0.5;
export const mostZoom = 12;

export interface CameraPose {
  /** Degrees, counter-clockwise as seen from above; -180 to 180. */
  turn: number;
  zoom: number;
  /** The place in the middle of the picture. */
  centre: Place;
}

export const frontPose: CameraPose = { turn: 0, zoom: 1, centre: { x: 0, y: 0 } };

/** The camera's rotation from straight before the scene, degrees: positive below it, as over a table; above an upright solid. */
export const cameraTilt = (tilt: number, surface: Surface): number => (surface.isUpright ? -tilt : tilt);

/** The picture after a turn, in a sentence; the tilt in degrees. */
export function turnWords({ turn }: CameraPose, tilt: number): string {
  const degrees = Math.round(Math.abs(turn));
  const values = { degrees, tilt: Math.round(tilt) };
  if (degrees === 0) return t('Not turned, tilted {tilt} degrees.', values);
  if (degrees === 180) return t('Turned by 180 degrees, tilted {tilt} degrees.', values);
  return turn > 0 ? t('Turned {degrees} degrees clockwise, tilted {tilt} degrees.', values) : t('Turned {degrees} degrees anticlockwise, tilted {tilt} degrees.', values);
}

/** The picture after a shift, in a sentence. */
export function shiftWords({ centre }: CameraPose): string {
  const way = wayWords(centre.x, centre.y);
  return way === '' ? t('The picture shows the middle of the scene.') : t('The picture is centred {way} from the middle of the scene.', { way });
}

export class Camera {
  private now = frontPose;

  get pose(): CameraPose {
    return this.now;
  }
  reset(): void {
    this.now = frontPose;
  }

  turnBy(degrees: number): void {
    const turn = this.now.turn + degrees;
    this.now = { ...this.now, turn: turn - 360 * Math.round(turn / 360) };
  }

  /** `about` keeps its position in the picture. */
  zoomBy(factor: number, about: Place | null, surface: Surface): void {
    const zoom = Math.min(mostZoom, Math.max(leastZoom, this.now.zoom * factor));
    const { centre } = this.now;
    const share = 1 - this.now.zoom / zoom;
    const moved = about === null ? centre : { x: centre.x + share * (about.x - centre.x), y: centre.y + share * (about.y - centre.y) };
    this.now = { ...this.now, zoom, centre: surface.clamp(moved) };
  }

  /** Shifts the picture by metres of the scene, relative to the view's right and up. */
  panBy(right: number, up: number, surface: Surface): void {
    const angle = (this.now.turn * Math.PI) / 180;
    const { centre } = this.now;
    const moved = { x: centre.x - right * Math.cos(angle) + up * Math.sin(angle), y: centre.y - right * Math.sin(angle) - up * Math.cos(angle) };
    this.now = { ...this.now, centre: surface.clamp(moved) };
  }
}
