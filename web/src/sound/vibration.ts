// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Short vibration pulses of the phone or a gamepad, if available. Rumble motors are slow, so for events only.

export function pulse(milliseconds: number, strength: number): void {
  // Browsers refuse vibration, with a warning, before the first user action.
  if (navigator.userActivation?.hasBeenActive !== false) navigator.vibrate?.(milliseconds);
  for (const pad of gamepads())
    void pad.vibrationActuator
      ?.playEffect('dual-rumble', { duration: Math.max(40, milliseconds), strongMagnitude: strength, weakMagnitude: strength })
      .catch(() => undefined);
}

function gamepads(): Gamepad[] {
  return typeof navigator.getGamepads === 'function' ? navigator.getGamepads().filter((pad) => pad !== null) : [];
}
