// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Reads a recording (docs/recording.md) of any length, block by block, into one track a probe.
import { t } from '../language';
import { Track, type Moment } from './track';

export interface Recording {
  name: string;
  /** Seconds, since the loop began. */
  begin: number;
  end: number;
  /** By the number of the probe. */
  tracks: ReadonlyMap<number, Track>;
  /** The files of the first scene that was touched. */
  inputs: readonly string[];
  /** Why the file was not read to its end; null: it was. */
  fault: string | null;
  /** Places of the proxy in contact, for a comparison with a surface; with the height factor of the scene. */
  contacts: readonly { x: number; y: number; z: number; heightFactor: number }[];
}

const magic = 'PALPREC1';
const chunkHead = 12;
const tickBytes = 192;
/** The largest chunk that is read: `TICK` chunks have up to 65 536 ticks. */
const mostChunk = 65_536 * tickBytes;
const mostText = 1 << 24;
const blockBytes = 1 << 22;
const mostContacts = 2000;
const contactEvery = 0.05;
/** Metres, newtons; seconds. What is beyond them is no touch. */
const farthest = 1e6;
const latest = 1e9;
const [hasContact, hasProxy, isPaused] = [1, 2, 128];

const crcTable = Uint32Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c;
});
export function crc32(bytes: Uint8Array): number {
  let c = 0xffffffff;
  for (const byte of bytes) c = crcTable[(c ^ byte) & 0xff]! ^ (c >>> 8);
  return ~c >>> 0;
}

/** Bytes of a file from the beginning on, read in blocks. */
class Blocks {
  private block = new Uint8Array(0);
  private at = 0;
  private read = 0;

  constructor(private readonly file: Blob) {}

  get fraction(): number {
    return this.file.size > 0 ? this.read / this.file.size : 1;
  }

  /** The next bytes; null if there are fewer. */
  async next(count: number): Promise<Uint8Array | null> {
    if (this.at + count > this.block.length) {
      const rest = this.block.subarray(this.at);
      const more = new Uint8Array(await this.file.slice(this.read, this.read + Math.max(blockBytes, count)).arrayBuffer());
      this.read += more.length;
      this.block = new Uint8Array(rest.length + more.length);
      this.block.set(rest);
      this.block.set(more, rest.length);
      this.at = 0;
    }
    if (count > this.block.length - this.at) return null;
    this.at += count;
    return this.block.subarray(this.at - count, this.at);
  }
}

/** What is known while the chunks are read. */
class Reading {
  readonly tracks = new Map<number, Track>();
  readonly contacts: { x: number; y: number; z: number; heightFactor: number }[] = [];
  inputs: readonly string[] = [];
  private readonly factors = new Map<number, number>();
  private contactAt = -Infinity;
  /** The time of each probe's last tick: a chunk of the hand's may hold several of those of `MORE`. */
  private readonly newest = new Map<number, number>();

  constructor(private readonly mostRows?: number) {}

  /** What is touched from now on; false: it cannot be read. */
  scene(payload: Uint8Array): boolean {
    try {
      const id = new DataView(payload.buffer, payload.byteOffset).getUint32(0, true);
      const about = JSON.parse(new TextDecoder().decode(payload.subarray(4))) as { depth?: unknown; scene_inputs?: unknown };
      this.factors.set(id, typeof about.depth === 'number' ? about.depth : 1);
      if (this.factors.size === 1 && Array.isArray(about.scene_inputs)) this.inputs = about.scene_inputs.filter((one): one is string => typeof one === 'string');
      return true;
    } catch {
      return false;
    }
  }

  /** False: a tick cannot be. */
  ticks(payload: Uint8Array): boolean {
    const view = new DataView(payload.buffer, payload.byteOffset, payload.byteLength);
    for (let at = 0; at + tickBytes <= view.byteLength; at += tickBytes) {
      const number = (offset: number) => view.getFloat64(at + offset, true);
      const t = number(8);
      const flags = view.getUint32(at + 176, true);
      const moment: Moment = {
        x: number(48), y: number(56), z: number(64), fx: number(144), fy: number(152), fz: number(160),
        contact: (flags & hasContact) !== 0, paused: (flags & isPaused) !== 0, label: view.getUint16(at + 188, true),
      };
      const probe = view.getUint8(at + 191);
      const isPossible = [moment.x, moment.y, moment.z, moment.fx, moment.fy, moment.fz].every((value) => Math.abs(value) <= farthest) && Math.abs(t) <= latest;
      if (!isPossible || probe > 9 || t < (this.newest.get(probe) ?? -Infinity)) return false;
      this.newest.set(probe, t);
      let track = this.tracks.get(probe);
      if (track === undefined) this.tracks.set(probe, (track = new Track(this.mostRows)));
      track.add(t, moment);
      if (moment.contact && (flags & hasProxy) !== 0 && this.contacts.length < mostContacts && t - this.contactAt >= contactEvery) {
        this.contactAt = t;
        this.contacts.push({ x: number(96), y: number(104), z: number(112), heightFactor: this.factors.get(view.getUint32(at + 184, true)) ?? 1 });
      }
    }
    return true;
  }
}

/** The recording in a file, or why there is none. `progress`: called with the share that is read. `mostRows`: of a track. */
export async function readRecording(name: string, file: Blob, progress: (share: number) => void = () => undefined, mostRows?: number): Promise<Recording | string> {
  const blocks = new Blocks(file);
  const text = (bytes: Uint8Array | null) => (bytes === null ? '' : String.fromCharCode(...bytes));
  if (text(await blocks.next(magic.length)) !== magic) return t('{name} is not a recording of this version of Palpable.', { name });
  const reading = new Reading(mostRows);
  let fault: string | null = t('It was interrupted, and is played to there.');
  for (;;) {
    const head = await blocks.next(chunkHead);
    if (head === null) break;
    // Later reads replace the block.
    const view = new DataView(head.slice().buffer);
    const [kind, size, sum] = [text(head.subarray(0, 4)), view.getUint32(4, true), view.getUint32(8, true)];
    const isTicks = kind === 'TICK' || kind === 'MORE';
    const payload = size <= (isTicks ? mostChunk : mostText) ? await blocks.next(size) : null;
    if (payload === null) break;
    if (crc32(payload) !== sum || (kind === 'PROG' && !reading.scene(payload)) || (isTicks && !reading.ticks(payload))) {
      fault = t('It is damaged, and is played to the damage.');
      break;
    }
    progress(blocks.fraction);
    if (kind !== 'END ') continue;
    fault = null;
    break;
  }
  const hand = reading.tracks.get(0);
  if (hand === undefined || hand.rows < 2) return t('{name} holds nothing that could be played.', { name });
  return { name, begin: hand.first, end: hand.last, tracks: reading.tracks, inputs: reading.inputs, fault, contacts: reading.contacts };
}
