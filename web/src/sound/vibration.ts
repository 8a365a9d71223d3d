// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Short pulses where the device can give them: the phone's own motor, or a gamepad's. Rumble is slow: events only.

export function pulse(milliseconds: number, strength: number): void {
  // Browsers refuse to vibrate before the person has touched the page once, and complain.
  if (navigator.userActivation?.hasBeenActive !== false) navigator.vibrate?.(milliseconds);
  for (const pad of gamepads())
    void pad.vibrationActuator
      ?.playEffect('dual-rumble', { duration: Math.max(40, milliseconds), strongMagnitude: strength, weakMagnitude: strength })
      .catch(() => undefined);
}

function gamepads(): Gamepad[] {
  return typeof navigator.getGamepads === 'function' ? navigator.getGamepads().filter((pad) => pad !== null) : [];
}
