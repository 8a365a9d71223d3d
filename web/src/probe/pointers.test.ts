// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import { Surface } from '../surface';
import { bindPointers, Pointing } from './pointers';
import { Probes } from './probes';

const flat = new Surface(10, 10, new Float32Array(100), 0.1, 0.1);

it('a mouse that rests or is bumped takes no probe from the keys', () => {
  const { own } = new Probes();
  const ownerDocument = new EventTarget();
  const stage = Object.assign(new EventTarget(), { ownerDocument, contains: () => false, getBoundingClientRect: () => ({ left: 0, top: 0 }), clientLeft: 0, clientTop: 0 });
  let moves = 0;
  const pointing = new Pointing(own, {
    surface: () => flat,
    moved: () => (moves += 1),
    came: () => undefined,
    left: () => undefined,
    full: () => undefined,
  });
  bindPointers(stage as unknown as HTMLElement, pointing, { placeAt: (left, top) => ({ x: left / 1000, y: top / 1000 }), wake: () => undefined });
  const event = (pointerType: string, screenX: number, clientX: number, on: EventTarget = stage) =>
    on.dispatchEvent(Object.assign(new Event('pointermove'), { pointerType, pointerId: 1, screenX, screenY: 5, clientX, clientY: 5 }));
  event('mouse', 30, 30);
  event('mouse', 30, 20);
  expect(moves).toBe(1);
  event('mouse', 31, 21);
  expect(moves).toBe(2);
  // To a button and back to the same point.
  event('mouse', 90, 90, ownerDocument);
  event('mouse', 31, 21);
  expect(moves).toBe(3);
  own.current.step(0.001, 0, 0, flat, 0);
  for (const x of [35, 38, 32]) event('mouse', x, x);
  expect(moves).toBe(3);
  event('mouse', 40, 40);
  event('mouse', 41, 41);
  expect(moves).toBe(5);
  // A pen at rest has a pressure that changes.
  event('pen', 31, 21);
  event('pen', 31, 21);
  expect(moves).toBe(7);
});
