// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Short vibration pulses of the phone and of gamepads, if available. Rumble motors are slow, so for events only.

/** Of the phone. */
export function vibratePhone(milliseconds: number): void {
  // Browsers refuse vibration, with a warning, before the first user action.
  if (navigator.userActivation?.hasBeenActive !== false) navigator.vibrate?.(milliseconds);
}

/** Of every gamepad; `strength` 0 ... 1. After the first call the browser polls gamepads until the page is closed. */
export function vibrateGamepads(milliseconds: number, strength: number): void {
  for (const pad of gamepads())
    void pad.vibrationActuator
      ?.playEffect('dual-rumble', { duration: Math.max(40, milliseconds), strongMagnitude: strength, weakMagnitude: strength })
      .catch(() => undefined);
}

function gamepads(): Gamepad[] {
  return typeof navigator.getGamepads === 'function' ? navigator.getGamepads().filter((pad) => pad !== null) : [];
}
