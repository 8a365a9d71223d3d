// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { glide, HeadPath, lostAfter } from './path';

const gains = { x: 1, y: 1, z: 1 };

/** Shows the path every 16 ms from `begin` to `end`; gives the last place and the greatest step. */
function run(path: HeadPath, begin: number, end: number, head: { x: number; y: number; z: number } | null, its = gains) {
  let largest = 0;
  let last = path.at(begin, 0.6, its);
  for (let now = begin; now <= end; now += 16) {
    if (head === null) path.miss(now);
    else path.add(now, head);
    const place = path.at(now, 0.6, its);
    largest = Math.max(largest, Math.hypot(place.x - last.x, place.y - last.y, place.z - last.z));
    last = place;
  }
  return { last, largest };
}

describe('the path of the view', () => {
  it('glides from the middle to the head, and back within a second when the head is lost, without a jump', () => {
    const path = new HeadPath();
    const head = { x: 0.1, y: 0.05, z: 0.5 };
    const found = run(path, 0, 3000, head);
    expect(found.last.x).toBeCloseTo(0.1, 9);
    expect(found.last.z).toBeCloseTo(-0.1, 9);
    const waiting = run(path, 3001, 3000 + lostAfter - 20, null);
    expect(waiting.last.x).toBeCloseTo(0.1, 9);
    expect(path.isSeen).toBe(true);
    const lost = run(path, 3000 + lostAfter, 3000 + lostAfter + glide + 50, null);
    expect(path.isSeen).toBe(false);
    expect(lost.last.x).toBeCloseTo(0, 12);
    const again = run(path, 6000, 6400, { x: -0.2, y: 0, z: 0.6 });
    for (const { largest } of [found, waiting, lost, again]) expect(largest).toBeLessThan(0.008);
  });
  it('stays with a head that is seen rarely', () => {
    const path = new HeadPath();
    for (let time = 0; time <= 6000; time += 1500) {
      path.add(time, { x: 0.1, y: 0, z: 0.6 });
      path.at(time, 0.6, gains);
    }
    expect(path.at(7400, 0.6, gains).x).toBeCloseTo(0.1, 9);
  });
  it('has a gain on each axis', () => {
    const { last } = run(new HeadPath(), 0, 3000, { x: 0.1, y: 0.1, z: 0.7 }, { x: 2, y: 0, z: 0.5 });
    expect(last.x).toBeCloseTo(0.2, 9);
    expect(last.y).toBeCloseTo(0, 12);
    expect(last.z).toBeCloseTo(0.05, 9);
  });
});
