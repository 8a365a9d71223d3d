// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { withDuration } from './webm_duration';

const element = (id: number[], content: number[]) => [...id, 0x80 | content.length, ...content];
const block = (time: number) => element([0xa3], [0x81, time >> 8, time & 0xff, 0x80, 1, 2, 3]);
const unknown = [0x01, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff];
const head = element([0x1a, 0x45, 0xdf, 0xa3], [0x42, 0x86, 0x81, 1]);
const scale = [0x2a, 0xd7, 0xb1, 0x83, 0x0f, 0x42, 0x40];
const clusters = [
  ...[0x1f, 0x43, 0xb6, 0x75, ...unknown, ...element([0xe7], [0]), ...block(0), ...block(33)],
  ...[0x1f, 0x43, 0xb6, 0x75, ...unknown, ...element([0xe7], [0x03, 0xe8]), ...block(0), ...block(34)],
];
const file = (info: number[]) => new Uint8Array([...head, 0x18, 0x53, 0x80, 0x67, ...unknown, ...element([0x15, 0x49, 0xa9, 0x66], info), ...clusters]);

describe('the duration of a clip', () => {
  it('is that of its last block and the time before it, in its header', () => {
    const made = withDuration(file(scale));
    const info = [...made.keys()].find((k) => made[k] === 0x15 && made[k + 1] === 0x49)!;
    const view = new DataView(made.buffer);
    expect(view.getUint32(info + 8)).toBe(11 + scale.length);
    expect([view.getUint16(info + 12), view.getFloat64(info + 15)]).toEqual([0x4489, 1034 + 34]);
    // All the rest is as it was.
    expect([...made.slice(0, info)]).toEqual([...file(scale).slice(0, info)]);
    expect([...made.slice(info + 23)]).toEqual([...scale, ...clusters]);
    expect(withDuration(made)).toBe(made);
  });

  it('is left out where the file is not understood', () => {
    for (const bytes of [[], [0], [0x1a, 0x45], [...head], [...file(scale).slice(0, 40)]]) {
      const given = new Uint8Array(bytes);
      expect(withDuration(given)).toBe(given);
    }
  });
});
