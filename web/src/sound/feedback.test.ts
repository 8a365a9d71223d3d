// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { afterEach, expect, it, vi } from 'vitest';
import type { ProbeState } from '../generated/protocol';
import { defaults, type Preferences } from '../settings/preferences';
import type { Surface } from '../surface';
import { Feedback } from './feedback';

afterEach(() => vi.unstubAllGlobals());

/** What the browser was asked for during a contact with these preferences. */
function contactWith(preferences: Partial<Preferences>) {
  const asked = { phone: 0, gamepads: 0, rumbles: 0 };
  const playEffect = () => {
    asked.rumbles += 1;
    return Promise.resolve('complete');
  };
  vi.stubGlobal('navigator', {
    vibrate: () => (asked.phone += 1),
    getGamepads: () => {
      asked.gamepads += 1;
      return [null, { vibrationActuator: { playEffect } }];
    },
  });
  const feedback = new Feedback();
  feedback.set({ ...defaults, sound: false, ...preferences });
  for (const contact of [false, true, true]) feedback.reported({ probe: 1, contact, x_m: 0 } as ProbeState, { sizeX: 0.1 } as Surface);
  return asked;
}

it('vibrates the phone at a contact, and does not ask for gamepads, which the browser would then poll', () =>
  expect(contactWith({})).toEqual({ phone: 1, gamepads: 0, rumbles: 0 }));
it('vibrates gamepads if that is chosen', () => expect(contactWith({ gamepads: true, vibration: false })).toEqual({ phone: 0, gamepads: 1, rumbles: 1 }));
