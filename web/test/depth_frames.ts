// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A folder of depth pictures of a person before a wall, for the program's source frames:FOLDER.
import { mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { deflateSync } from 'node:zlib';

const [width, height, focal] = [160, 120, 140];
const wall = 2;

/** In metres from the camera: right, down, ahead. */
export type Place = readonly [number, number, number];

function chunk(type: string, data: Buffer): Buffer {
  const body = Buffer.concat([Buffer.from(type, 'latin1'), data]);
  const whole = Buffer.alloc(body.length + 8);
  whole.writeUInt32BE(data.length, 0);
  body.copy(whole, 4);
  whole.writeUInt32BE(checksum(body), body.length + 4);
  return whole;
}

/** CRC-32. */
function checksum(data: Buffer): number {
  let crc = 0xffffffff;
  for (const byte of data) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return (crc ^ 0xffffffff) >>> 0;
}

/** Depths in metres as a grey PNG of 16 bits, in millimetres. */
function png(depths: Float64Array): Buffer {
  const rows = Buffer.alloc(height * (1 + 2 * width));
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) rows.writeUInt16BE(Math.round(1000 * depths[y * width + x]!), y * (1 + 2 * width) + 1 + 2 * x);
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([16, 0, 0, 0, 0], 8);
  const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
  return Buffer.concat([signature, chunk('IHDR', header), chunk('IDAT', deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]);
}

/** Head, neck and shoulders as ellipsoids; null: the wall alone. */
function picture(head: Place | null): Buffer {
  const depths = new Float64Array(width * height).fill(wall);
  if (head === null) return png(depths);
  const parts = [
    { at: [0, 0, 0], half: [0.077, 0.115, 0.098] },
    { at: [0, 0.15, 0.02], half: [0.06, 0.09, 0.06] },
    { at: [0, 0.32, 0.03], half: [0.21, 0.12, 0.11] },
  ];
  const dot = (a: number[], b: number[]) => a.reduce((sum, value, k) => sum + value * b[k]!, 0);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x)
      for (const { at, half } of parts) {
        const ray = [(x - (width - 1) / 2) / focal, (y - (height - 1) / 2) / focal, 1].map((value, k) => value / half[k]!);
        const middle = at.map((value, k) => (value + head[k]!) / half[k]!);
        const [a, b] = [dot(ray, ray), dot(ray, middle)];
        const under = b * b - a * (dot(middle, middle) - 1);
        if (under >= 0) depths[y * width + x] = Math.min(depths[y * width + x]!, (b - Math.sqrt(under)) / a);
      }
  return png(depths);
}

/** Writes a frame for each place; gives the folder. */
export function writeDepthFrames(heads: readonly (Place | null)[]): string {
  const folder = mkdtempSync(join(tmpdir(), 'palpable-depth-'));
  const made = new Map<string, Buffer>();
  heads.forEach((head, k) => {
    const key = JSON.stringify(head);
    if (!made.has(key)) made.set(key, picture(head));
    writeFileSync(join(folder, `${String(k).padStart(4, '0')}.depth.png`), made.get(key)!);
  });
  writeFileSync(join(folder, 'intrinsics.K.txt'), `${focal} 0 ${(width - 1) / 2}\n0 ${focal} ${(height - 1) / 2}\n0 0 1\n`);
  return folder;
}
