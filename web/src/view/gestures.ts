// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Gestures that move the picture instead of a probe: the wheel, drags with the right or middle button, and, in the mode for
// moving the picture (`isMoving`), every drag and pinch.

export interface GestureTarget {
  isMoving(): boolean;
  /** The pointer's movement in CSS pixels, to the right and down. */
  turn(right: number, down: number): void;
  pan(right: number, down: number): void;
  /** Zooms about a point in CSS pixels from the stage's upper left corner. */
  zoom(factor: number, left: number, top: number): void;
}

interface Finger {
  left: number;
  top: number;
}

const wheelRate = 0.0015;

/** Bind this before the handlers of the probes, since it consumes its own events. */
export function bindGestures(stage: HTMLElement, target: GestureTarget): void {
  const fingers = new Map<number, Finger>();
  const at = (event: MouseEvent): Finger => {
    const box = stage.getBoundingClientRect();
    return { left: event.clientX - box.left - stage.clientLeft, top: event.clientY - box.top - stage.clientTop };
  };
  const middle = (): Finger & { spread: number } => {
    const all = [...fingers.values()];
    const [left, top] = [all.reduce((sum, one) => sum + one.left, 0) / all.length, all.reduce((sum, one) => sum + one.top, 0) / all.length];
    return { left, top, spread: all.reduce((sum, one) => sum + Math.hypot(one.left - left, one.top - top), 0) / all.length };
  };
  stage.addEventListener('contextmenu', (event) => event.preventDefault());
  stage.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1);
      const { left, top } = at(event);
      target.zoom(Math.exp(-wheelRate * pixels), left, top);
    },
    { passive: false },
  );
  stage.addEventListener('pointerdown', (event) => {
    if (!target.isMoving() && event.button === 0) return;
    event.stopImmediatePropagation();
    event.preventDefault();
    stage.focus({ preventScroll: true });
    stage.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, at(event));
  });
  stage.addEventListener('pointermove', (event) => {
    if (!fingers.has(event.pointerId)) {
      if (target.isMoving()) event.stopImmediatePropagation();
      return;
    }
    event.stopImmediatePropagation();
    const before = middle();
    fingers.set(event.pointerId, at(event));
    const now = middle();
    const [right, down] = [now.left - before.left, now.top - before.top];
    if (fingers.size > 1) {
      target.pan(right, down);
      if (before.spread > 0) target.zoom(now.spread / before.spread, now.left, now.top);
    } else if (event.shiftKey || (event.buttons & 4) !== 0) {
      target.pan(right, down);
    } else {
      target.turn(right, down);
    }
  });
  for (const end of ['pointerup', 'pointercancel'] as const)
    stage.addEventListener(end, (event) => {
      if (fingers.delete(event.pointerId)) event.stopImmediatePropagation();
    });
}
