// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Writes the duration into the header of a WebM file: browsers leave it out while they record, and some players then cannot
// seek. The format: EBML (RFC 8794) and Matroska (RFC 9559).

/** Identifiers, with their length marker. */
const id = { ebml: 0x1a45dfa3, segment: 0x18538067, info: 0x1549a966, scale: 0x2ad7b1, duration: 0x4489, cluster: 0x1f43b675, time: 0xe7, block: 0xa3, group: 0xa0, inGroup: 0xa1 };
/** Elements whose children are read. */
const nested = new Set([id.segment, id.cluster, id.group]);

interface Element {
  id: number;
  /** Where its content begins and ends; of unknown size it ends with the file. */
  begin: number;
  end: number;
}

/** A number of variable length; `marked`: with the bit that tells its length. Null: there is none. */
function readNumber(bytes: Uint8Array, at: number, marked: boolean): { value: number; end: number; isUnknown: boolean } | null {
  const first = bytes[at] ?? 0;
  const length = Math.clz32(first) - 23;
  if (first === 0 || at + length > bytes.length) return null;
  let value = marked ? first : first & (0xff >> length);
  let isUnknown = (first | (0xff << (8 - length)) & 0xff) === 0xff;
  for (let k = 1; k < length; ++k) {
    value = value * 256 + bytes[at + k]!;
    isUnknown &&= bytes[at + k] === 0xff;
  }
  return { value, end: at + length, isUnknown };
}

function readElement(bytes: Uint8Array, at: number): Element | null {
  const name = readNumber(bytes, at, true);
  const size = name && readNumber(bytes, name.end, false);
  if (!size) return null;
  return { id: name.value, begin: size.end, end: size.isUnknown ? bytes.length : Math.min(bytes.length, size.end + size.value) };
}

const readUnsigned = (bytes: Uint8Array, { begin, end }: Element) => bytes.subarray(begin, end).reduce((value, byte) => value * 256 + byte, 0);

/** A walk over the elements, in their order, into those that are nested. */
function* elementsOf(bytes: Uint8Array): Generator<Element> {
  for (let at = 0; at < bytes.length; ) {
    const element = readElement(bytes, at);
    if (element === null) return;
    yield element;
    at = nested.has(element.id) ? element.begin : element.end;
  }
}

/** The Info element, with the duration as its first child. */
function infoWith(duration: number, content: Uint8Array): Uint8Array {
  const info = new Uint8Array(4 + 8 + 11 + content.length);
  const view = new DataView(info.buffer);
  view.setUint32(0, id.info);
  // A size of eight bytes.
  view.setUint32(4, 0x01000000);
  view.setUint32(8, 11 + content.length);
  view.setUint16(12, id.duration);
  view.setUint8(14, 0x88);
  view.setFloat64(15, duration);
  info.set(content, 23);
  return info;
}

/** The file with its duration; the same file if it has one, or is not understood. */
export function withDuration(file: Uint8Array<ArrayBuffer>): Uint8Array<ArrayBuffer> {
  let info: { element: Element; head: number } | null = null;
  let [cluster, last, before, segment, at] = [0, 0, 0, null as Element | null, 0];
  for (const element of elementsOf(file)) {
    const head = at;
    at = nested.has(element.id) ? element.begin : element.end;
    if (element.id === id.segment) segment = element;
    if (element.id === id.info) info = { element, head };
    if (element.id === id.time) cluster = readUnsigned(file, element);
    if (element.id !== id.block && element.id !== id.inGroup) continue;
    // The number of its track, then its time relative to the cluster's.
    const track = readNumber(file, element.begin, false);
    if (track === null || track.end + 2 > file.length) continue;
    const time = cluster + new DataView(file.buffer, file.byteOffset).getInt16(track.end);
    if (time > last) [before, last] = [last, time];
  }
  // A segment of known size would have to be enlarged, and nobody records one.
  if (info === null || segment === null || segment.end !== file.length || last === 0) return file;
  const content = file.subarray(info.element.begin, info.element.end);
  for (let k = 0; k < content.length; ) {
    const child = readElement(content, k);
    if (child === null || child.id === id.duration) return file;
    k = child.end;
  }
  // The last picture is shown as long as the one before it.
  const whole = infoWith(last + (last - before), content);
  const made = new Uint8Array(file.length - (info.element.end - info.head) + whole.length);
  made.set(file.subarray(0, info.head));
  made.set(whole, info.head);
  made.set(file.subarray(info.element.end), info.head + whole.length);
  return made;
}
