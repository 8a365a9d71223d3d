// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The data inside the page: the touch, the scene and its picture, in base 64, the first two compressed by gzip.
import { element } from '../dom';

/** Whether the file is complete: its last element is there. Otherwise watch.js has said so. */
export const isComplete = (): boolean => document.getElementById('data-end') !== null;

function bytesIn(id: string): Uint8Array<ArrayBuffer> {
  const text = atob(element(id).textContent ?? '');
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** The data with this id; throws if it is damaged: gzip holds a checksum. */
export async function unpacked(id: string): Promise<Uint8Array<ArrayBuffer>> {
  const stream = new Blob([bytesIn(id)]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export interface Pixels {
  width: number;
  height: number;
  /** Red, green, blue, opacity. */
  rgba: Uint8ClampedArray;
}

/** The picture with this id; null if the scene has none. */
export async function picture(id: string): Promise<Pixels | null> {
  const bytes = bytesIn(id);
  if (bytes.length === 0) return null;
  const bitmap = await createImageBitmap(new Blob([bytes]), { colorSpaceConversion: 'none' });
  const { width, height } = bitmap;
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  const pen = canvas.getContext('2d', { willReadFrequently: true })!;
  pen.drawImage(bitmap, 0, 0);
  bitmap.close();
  return { width, height, rgba: pen.getImageData(0, 0, width, height).data };
}
