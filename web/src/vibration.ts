// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Short pulses where the device can give them: the phone's own motor, or a gamepad's. Rumble is slow: events only.

export function canVibrate(): boolean {
  return typeof navigator.vibrate === 'function' || gamepads().length > 0;
}

export function pulse(milliseconds: number, strength: number): void {
  // A browser that has vibrate() but no motor says so only by doing nothing.
  navigator.vibrate?.(milliseconds);
  for (const pad of gamepads())
    void pad.vibrationActuator
      ?.playEffect('dual-rumble', { duration: Math.max(40, milliseconds), strongMagnitude: strength, weakMagnitude: strength })
      .catch(() => undefined);
}

function gamepads(): Gamepad[] {
  return typeof navigator.getGamepads === 'function' ? navigator.getGamepads().filter((pad) => pad !== null) : [];
}
