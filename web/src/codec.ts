// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Parses the program's messages strictly by the definitions of protocol.json. The C++ side is page/protocol.cpp.
import { objectSpecs, raster, toPageSpecs, toShelfSpecs, type FromPage, type FromShelf, type ToPage, type ToShelf } from './generated/protocol';

export interface FieldSpec {
  /** number, integer, boolean, string, or the name of an object. */
  type: string;
  min?: number;
  max?: number;
  /** A list of at most this many values. */
  max_count?: number;
  nullable?: boolean;
}
export type Specs = Record<string, Record<string, FieldSpec>>;

const bytesOf = (text: string) => new TextEncoder().encode(text).length;
const isPlainObject = (value: unknown): value is Record<string, unknown> => typeof value === 'object' && value !== null && !Array.isArray(value);

function fits(value: unknown, spec: FieldSpec): boolean {
  const { max_count, ...element } = spec;
  if (max_count !== undefined) return Array.isArray(value) && value.length <= max_count && value.every((one) => fits(one, element));
  const { min = -Infinity, max = Infinity } = spec;
  if (value === null) return spec.nullable === true;
  switch (spec.type) {
    case 'boolean':
      return typeof value === 'boolean';
    case 'integer':
      return Number.isInteger(value) && (value as number) >= min && (value as number) <= max;
    case 'number':
      return typeof value === 'number' && value >= min && value <= max;
    case 'string':
      return typeof value === 'string' && bytesOf(value) <= max;
    default:
      return isPlainObject(value) && complaintAbout(value, objectSpecs[spec.type] ?? {}) === null;
  }
}

/** The error of an object with these fields; null if it is valid. `besides`: number of other keys. */
function complaintAbout(object: Record<string, unknown>, fields: Record<string, FieldSpec>, besides = 0): string | null {
  for (const [name, spec] of Object.entries(fields))
    if (!Object.hasOwn(object, name) || !fits(object[name], spec)) return `'${name}' is missing or out of its limits`;
  return Object.keys(object).length === Object.keys(fields).length + besides ? null : 'there are fields that the message does not have';
}

/** The message in a text frame, or an error message. */
export function readMessage(text: string, specs: Specs = toPageSpecs): ToPage | string {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    return 'the message is not JSON';
  }
  if (!isPlainObject(value)) return 'the message is not an object';
  const fields = typeof value.type === 'string' && Object.hasOwn(specs, value.type) ? specs[value.type] : undefined;
  if (fields === undefined) return 'there is no message of that type';
  const complaint = complaintAbout(value, fields, 1);
  return complaint === null ? (value as unknown as ToPage) : `${String(value.type)}: ${complaint}`;
}

/** The same for an answer to the home page. */
export const readShelfMessage = (text: string) => readMessage(text, toShelfSpecs) as unknown as ToShelf | string;

export function writeMessage(message: FromPage | FromShelf): string {
  return JSON.stringify(message);
}

export interface HeightsFrame {
  kind: 'heights';
  scene: number;
  columns: number;
  rows: number;
  /** Metres, row-major, origin top-left. */
  heights: Float32Array;
}
export interface ShiftFrame {
  kind: 'shift';
  scene: number;
  columns: number;
  rows: number;
  /** How much farther left the second picture shows each place of the surface: shares of its width, row-major, origin top-left. */
  shares: Float32Array;
}
export interface PictureFrame {
  kind: 'picture' | 'cells' | 'second';
  scene: number;
  columns: number;
  rows: number;
  /** Three bytes per pixel, sRGB. */
  rgb: Uint8Array;
}

export type RasterFrame = HeightsFrame | ShiftFrame | PictureFrame;

/** The raster in a binary frame, or an error message. */
export function readRaster(buffer: ArrayBuffer): RasterFrame | string {
  const headerBytes = 4 * raster.header.length;
  if (buffer.byteLength < headerBytes) return 'the frame is too short';
  const view = new DataView(buffer);
  const [magic, kind, scene, columns, rows] = raster.header.map((_, i) => view.getUint32(4 * i, true)) as [
    number, number, number, number, number,
  ];
  if (magic !== raster.magic) return 'the frame is not a raster';
  const name = (Object.keys(raster.kinds) as (keyof typeof raster.kinds)[]).find((one) => raster.kinds[one] === kind);
  if (name === undefined) return 'there is no raster of that kind';
  const hasFloats = name === 'heights' || name === 'shift';
  if (columns < 1 || rows < 1 || buffer.byteLength - headerBytes !== columns * rows * (hasFloats ? 4 : 3))
    return 'the raster is not as long as its size says';
  if (!hasFloats) return { kind: name, scene, columns, rows, rgb: new Uint8Array(buffer, headerBytes) };
  const values = new Float32Array(columns * rows);
  for (let i = 0; i < values.length; ++i) values[i] = view.getFloat32(headerBytes + 4 * i, true);
  if (!values.every(Number.isFinite)) return 'a height is not a number';
  return name === 'heights' ? { kind: name, scene, columns, rows, heights: values } : { kind: name, scene, columns, rows, shares: values };
}
