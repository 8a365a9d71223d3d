// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Mouse, pen and fingers on the stage: their positions and probes.
import type { PageProbes } from './page_probes';
import type { Place, Surface } from '../surface';

export interface PointersTarget {
  surface(): Surface | null;
  /** The place under a point of the stage (CSS pixels from its upper left corner). */
  placeAt(left: number, top: number): Place | null;
  /** A user action: sound may start. */
  wake(): void;
  /** A probe has a new target. */
  moved(): void;
  came(probe: number): void;
  left(probe: number): void;
  /** The maximum number of probes is reached. */
  full(): void;
}

export function bindPointers(stage: HTMLElement, probes: PageProbes, target: PointersTarget): void {
  const placeOf = (event: PointerEvent): Place | null => {
    const box = stage.getBoundingClientRect();
    return target.placeAt(event.clientX - box.left - stage.clientLeft, event.clientY - box.top - stage.clientTop);
  };
  /** Where the mouse is on the screen. */
  let mouse = { x: NaN, y: NaN };
  /** Browsers report a mouse that rests also where the page has moved below it: then the hand has done nothing. */
  const rests = (event: PointerEvent): boolean => {
    if (event.pointerType !== 'mouse') return false;
    const before = mouse;
    mouse = { x: event.screenX, y: event.screenY };
    return before.x === mouse.x && before.y === mouse.y;
  };
  const aim = (event: PointerEvent): void => {
    const surface = target.surface();
    const probe = probes.movedBy(event.pointerId);
    const moved = probe === null ? undefined : probes.at(probe);
    if (surface === null || moved === undefined) return;
    const place = placeOf(event);
    if (place) moved.aim(place, surface, performance.now());
    if (event.pointerType === 'pen' && event.pressure > 0) moved.penPressure(event.pressure);
    target.moved();
  };
  const release = (event: PointerEvent): void => {
    const gone = probes.release(event.pointerId);
    if (gone !== null) target.left(gone);
  };
  stage.addEventListener('pointermove', (event) => {
    if (!rests(event)) aim(event);
  });
  stage.addEventListener('pointerdown', (event) => {
    target.wake();
    stage.setPointerCapture(event.pointerId);
    const surface = target.surface();
    const place = placeOf(event);
    if (surface === null || place === null) return;
    const pressed = probes.press(event.pointerId, surface.clamp(place));
    if (pressed === null) return target.full();
    if (pressed.isNew) target.came(pressed.probe);
    aim(event);
  });
  stage.addEventListener('pointerup', release);
  stage.addEventListener('pointercancel', release);
}
