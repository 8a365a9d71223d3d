// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { RestingHand } from './resting_hand';

const at = (x: number) => ({ x, y: 0, z: 0 });

describe('a resting hand', () => {
  it('is unknown before anything was felt', () => expect(new RestingHand().place(1, 0)).toBeNull());

  it('is where it was half a second ago and since, trembling a little', () => {
    const hand = new RestingHand();
    hand.add(at(5), 0);
    for (let k = 0; k < 60; ++k) hand.add(at(1 + (k % 2) * 0.001), 1000 + 10 * k);
    expect(hand.place(0.01, 1600)!.x).toBeCloseTo(1.0005, 4);
  });

  it('moved if its last place came within the period', () => {
    const hand = new RestingHand();
    hand.add(at(0), 0);
    hand.add(at(1), 900);
    expect(hand.place(0.01, 1000)).toBeNull();
    // Nothing else was sent: it stayed.
    expect(hand.place(0.01, 1500)).toEqual(at(1));
  });

  it('is forgotten', () => {
    const hand = new RestingHand();
    hand.add(at(1), 0);
    hand.forget();
    expect(hand.place(1, 1)).toBeNull();
  });
});
