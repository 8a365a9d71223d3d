// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Mouse, pen and fingers on the stage: their positions and probes.
import type { PageProbes } from './page_probes';
import type { Place, Surface } from '../surface';

export interface PointingTarget {
  surface(): Surface | null;
  /** A probe has a new target. */
  moved(): void;
  came(probe: number): void;
  left(probe: number): void;
  /** The maximum number of probes is reached. */
  full(): void;
}

/** CSS pixels: a mouse that moved by less has not taken the probe from the keys. A table that is bumped moves it by a few. */
const bump = 8;

/** What pointers do with the probes, whatever they are: each has a number. */
export class Pointing {
  constructor(
    private readonly probes: PageProbes,
    private readonly target: PointingTarget,
  ) {}

  /** Whether keys moved the probe of this pointer last. */
  isByKeys(pointer: number): boolean {
    const probe = this.probes.movedBy(pointer);
    return probe !== null && (this.probes.at(probe)?.isByKeys ?? false);
  }

  /** `pressure`: of a pen, 0 to 1. */
  aim(pointer: number, place: Place | null, pressure = 0): void {
    const surface = this.target.surface();
    const probe = this.probes.movedBy(pointer);
    const moved = probe === null ? undefined : this.probes.at(probe);
    if (surface === null || moved === undefined) return;
    if (place) moved.aim(place, surface, performance.now());
    if (pressure > 0) moved.penPressure(pressure);
    this.target.moved();
  }

  press(pointer: number, place: Place | null, pressure = 0): void {
    const surface = this.target.surface();
    if (surface === null || place === null) return;
    const pressed = this.probes.press(pointer, surface.clamp(place));
    if (pressed === null) return this.target.full();
    if (pressed.isNew) this.target.came(pressed.probe);
    this.aim(pointer, place, pressure);
  }

  release(pointer: number): void {
    const gone = this.probes.release(pointer);
    if (gone !== null) this.target.left(gone);
  }
}

export interface StagePointers {
  /** The place under a point of the stage (CSS pixels from its upper left corner). */
  placeAt(left: number, top: number): Place | null;
  /** A user action: sound may start. */
  wake(): void;
}

export function bindPointers(stage: HTMLElement, pointing: Pointing, { placeAt, wake }: StagePointers): void {
  const placeOf = (event: PointerEvent): Place | null => {
    const box = stage.getBoundingClientRect();
    return placeAt(event.clientX - box.left - stage.clientLeft, event.clientY - box.top - stage.clientTop);
  };
  const pressureOf = (event: PointerEvent): number => (event.pointerType === 'pen' ? event.pressure : 0);
  /** Where the mouse is on the screen; while keys move the probe: where it was left. */
  let mouse = { x: NaN, y: NaN };
  /** Browsers report a mouse that rests also where the page has moved below it: then the hand has done nothing. */
  const rests = (event: PointerEvent): boolean => {
    if (event.pointerType !== 'mouse') return false;
    if (Math.hypot(event.screenX - mouse.x, event.screenY - mouse.y) <= (pointing.isByKeys(event.pointerId) ? bump : 0)) return true;
    mouse = { x: event.screenX, y: event.screenY };
    return false;
  };
  // Elsewhere on the page it may have gone anywhere, also back to where it was.
  stage.ownerDocument.addEventListener('pointermove', (event) => {
    if (event.pointerType === 'mouse' && !stage.contains(event.target as Node | null)) mouse = { x: event.screenX, y: event.screenY };
  });
  const release = (event: PointerEvent): void => pointing.release(event.pointerId);
  stage.addEventListener('pointermove', (event) => {
    if (!rests(event)) pointing.aim(event.pointerId, placeOf(event), pressureOf(event));
  });
  stage.addEventListener('pointerdown', (event) => {
    wake();
    stage.setPointerCapture(event.pointerId);
    pointing.press(event.pointerId, placeOf(event), pressureOf(event));
  });
  stage.addEventListener('pointerup', release);
  stage.addEventListener('pointercancel', release);
}
