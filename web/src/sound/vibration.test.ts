// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The patterns of docs/page.md, as lists of the calls that motors get.
import { afterEach, describe, expect, it, vi } from 'vitest';
import { browserMotors, texturePattern, Vibrator, type Rumble } from './vibration';

afterEach(() => vi.unstubAllGlobals());

function recorded(answer: boolean | null = true) {
  const calls: (number[] | Rumble)[] = [];
  const said: string[] = [];
  const motors = {
    phone: (pattern: readonly number[]) => {
      calls.push([...pattern]);
      return answer;
    },
    pads: (rumble: Rumble) => void calls.push(rumble),
    held: (pads: readonly Gamepad[], rumble: Rumble) => void pads.forEach(() => calls.push(rumble)),
  };
  return { calls, said, vibrator: new Vibrator(motors, (sentence) => said.push(sentence)) };
}

it('is felt in the controllers of a headset instead of the phone, unless it is off', () => {
  const { calls, vibrator } = recorded();
  const pad = {} as Gamepad;
  vibrator.set(true, false);
  vibrator.hold(() => [pad]);
  vibrator.contact(1, 0);
  expect(calls).toEqual([{ duration: 80, strong: 1, weak: 0.5 }]);
  vibrator.set(false, false);
  vibrator.contact(1, 0);
  expect(calls).toHaveLength(1);
  vibrator.set(true, false);
  vibrator.hold(null);
  vibrator.contact(0, 0);
  expect(calls[1]).toEqual([12]);
});

describe('the phone', () => {
  it('gets one pulse for a contact, longer when harder, and two short ones for an edge', () => {
    const { calls, vibrator } = recorded();
    vibrator.set(true, false);
    vibrator.contact(0, 0);
    vibrator.contact(1, 0);
    vibrator.edge(0);
    expect(calls).toEqual([[12], [40], [10, 30, 10]]);
  });
  it('gets as many pulses as forms of the texture pass, up to what its motor can separate', () => {
    const pulses = (rate: number) => (texturePattern(rate).length + 1) / 2;
    expect(texturePattern(0)).toEqual([]);
    expect(texturePattern(3)).toEqual([]);
    expect([4, 8, 12, 14].map(pulses)).toEqual([1, 2, 3, 3]);
    expect(pulses(200)).toBe(pulses(14));
    // Denser textures, then, are stronger.
    expect(texturePattern(200)[0]).toBeGreaterThan(texturePattern(14)[0]!);
    for (const rate of [4, 8, 14, 50, 200, 1e6]) {
      const pattern = texturePattern(rate);
      expect(pattern.every((part) => part >= 8 && part < 250 && Number.isInteger(part))).toBe(true);
      expect(pattern.reduce((a, b) => a + b)).toBeLessThanOrEqual(252);
    }
  });
  it('goes on with a texture only when its pattern has ended; an event replaces it', () => {
    const { calls, vibrator } = recorded();
    vibrator.set(true, false);
    for (let now = 0; now < 1000; now += 16) vibrator.texture(10, 0.5, now);
    expect(calls.length).toBeGreaterThanOrEqual(4);
    expect(calls.length).toBeLessThanOrEqual(9);
    calls.length = 0;
    vibrator.texture(10, 0.5, 2000);
    vibrator.edge(2010);
    vibrator.texture(10, 0.5, 2030);
    expect(calls.map((call) => (call as number[]).length)).toEqual([3, 3]);
    expect(calls[1]).toEqual([10, 30, 10]);
  });
  it('that has no vibration, or refuses it, is told of once', () => {
    for (const [answer, sentence] of [
      [null, 'This device does not vibrate for pages: sound tells contact and edges.'],
      [false, 'Vibration is refused by this device or its browser: sound tells contact and edges.'],
    ] as const) {
      const { said, vibrator } = recorded(answer);
      vibrator.set(true, false);
      vibrator.edge(0);
      vibrator.contact(1, 500);
      expect(said).toEqual([sentence]);
    }
  });
});

it('a gamepad gets its strong motor for contact, its fast one for edges and textures; neither when off', () => {
  const { calls, vibrator } = recorded();
  vibrator.set(false, true);
  vibrator.contact(1, 0);
  vibrator.edge(500);
  vibrator.texture(20, 0.5, 1000);
  expect(calls).toEqual([
    { duration: 80, strong: 1, weak: 0.5 },
    { duration: 40, strong: 0, weak: 0.6 },
    { duration: 250, strong: 0, weak: 0.2 },
  ]);
  vibrator.set(false, false);
  calls.length = 0;
  vibrator.contact(1, 2000);
  expect(calls).toEqual([]);
});

describe('the browser', () => {
  const asked: unknown[] = [];
  const within = (navigator: object, coarse = true) => {
    asked.length = 0;
    vi.stubGlobal('navigator', navigator);
    vi.stubGlobal('matchMedia', () => ({ matches: coarse }));
  };
  const vibrate = (pattern: unknown) => asked.push(pattern) > 0;

  it('is not asked before the first user action, which it would complain of', () => {
    within({ vibrate, userActivation: { hasBeenActive: false } });
    expect(browserMotors.phone([20])).toBe(true);
    expect(asked).toEqual([]);
    within({ vibrate, userActivation: { hasBeenActive: true } });
    expect(browserMotors.phone([20])).toBe(true);
    expect(asked).toEqual([[20]]);
  });
  it('of a phone without vibration says so (iOS), of a desk it does not matter', () => {
    within({});
    expect(browserMotors.phone([20])).toBeNull();
    within({}, false);
    expect(browserMotors.phone([20])).toBe(true);
  });
  it('that forbids vibration says so', () => {
    within({ vibrate: () => false });
    expect(browserMotors.phone([20])).toBe(false);
  });
  it('reaches both kinds of motors of gamepads and joysticks, and survives their refusal', async () => {
    const refuse = (...values: unknown[]) => {
      asked.push(values);
      return Promise.reject(new Error('no'));
    };
    within({ getGamepads: () => [null, { vibrationActuator: { playEffect: refuse } }, { hapticActuators: [{ pulse: refuse }] }, {}] });
    browserMotors.pads({ duration: 60, strong: 0.2, weak: 0.7 });
    await Promise.resolve();
    expect(asked).toEqual([
      ['dual-rumble', { duration: 60, strongMagnitude: 0.2, weakMagnitude: 0.7 }],
      [0.7, 60],
    ]);
  });
});
