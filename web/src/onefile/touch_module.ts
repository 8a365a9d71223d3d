// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The touch, compiled from C++ (src/palpable/onefile/wasm/exports.cpp), as functions.
import type { Pixels } from './embedded';

/** The functions of exports.cpp; addresses and sizes are numbers of bytes. */
interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  palpable_allocate(bytes: number): number;
  palpable_release(memory: number): void;
  palpable_sentence(): number;
  palpable_open(bytes: number, size: number, rgbx: number, width: number, height: number, rightRgbx: number, rightWidth: number, rightHeight: number): number;
  palpable_receive(text: number, size: number): void;
  palpable_advance(seconds: number): number;
  palpable_take_frame(): number;
  palpable_frame(): number;
  palpable_frame_size(): number;
  palpable_probe(options: number, size: number, rows: number, count: number): number;
}

/** Rows t_s, x_m, y_m, z_m; and fx_N, fy_N, fz_N, contact. */
export type Row = readonly [number, number, number, number];

const textFrame = 1;

/** What the standard library asks of its surroundings: the time, and a place for what it prints before it gives up. */
function surroundings(memory: () => WebAssembly.Memory): WebAssembly.Imports {
  const view = () => new DataView(memory().buffer);
  const notThere = 8; // EBADF of WASI: there are no files.
  const wasi: Record<string, (...values: never[]) => number> = {
    clock_time_get: (_clock: number, _precision: bigint, out: number) => {
      view().setBigUint64(out, BigInt(Math.round(performance.now() * 1e6)), true);
      return 0;
    },
    fd_write: (_file: number, parts: number, count: number, written: number) => {
      let text = '';
      let size = 0;
      for (let part = parts; part < parts + 8 * count; part += 8) {
        const length = view().getUint32(part + 4, true);
        text += new TextDecoder().decode(new Uint8Array(memory().buffer, view().getUint32(part, true), length));
        size += length;
      }
      console.error(text);
      view().setUint32(written, size, true);
      return 0;
    },
    proc_exit: (code: number) => {
      throw new Error(`the touch has ended with ${code}`);
    },
  };
  const others = new Proxy(wasi, { get: (known, name: string) => known[name] ?? (() => notThere) });
  return {
    wasi_snapshot_preview1: others as WebAssembly.ModuleImports,
    env: { emscripten_notify_memory_growth: () => undefined },
  };
}

export class TouchModule {
  private constructor(private readonly exports: Exports) {}

  static async load(wasm: Uint8Array<ArrayBuffer>): Promise<TouchModule> {
    let memory: WebAssembly.Memory;
    const { instance } = await WebAssembly.instantiate(wasm, surroundings(() => memory));
    const exports = instance.exports as unknown as Exports;
    memory = exports.memory;
    exports._initialize();
    return new TouchModule(exports);
  }

  /** Throws the sentence if the scene cannot be touched. */
  open(scene: Uint8Array, picture: Pixels | null, second: Pixels | null): void {
    const none: Pixels = { width: 0, height: 0, rgba: new Uint8ClampedArray(0) };
    const left = picture ?? none;
    const right = second ?? none;
    const opened = this.with(scene, (at) =>
      this.with(left.rgba, (pixels) =>
        this.with(right.rgba, (rightPixels) =>
          this.exports.palpable_open(at, scene.length, pixels, left.width, left.height, rightPixels, right.width, right.height),
        ),
      ),
    );
    if (opened === 0) throw new Error(this.sentence());
  }

  receive(text: string): void {
    const bytes = new TextEncoder().encode(text);
    this.with(bytes, (at) => this.exports.palpable_receive(at, bytes.length));
  }

  /** Runs the touch for this time (s); false at rest. */
  advance(seconds: number): boolean {
    return this.exports.palpable_advance(seconds) !== 0;
  }

  /** The frames that wait for the page. */
  *frames(): Generator<string | ArrayBuffer> {
    for (let kind = this.exports.palpable_take_frame(); kind !== 0; kind = this.exports.palpable_take_frame()) {
      const bytes = new Uint8Array(this.exports.memory.buffer, this.exports.palpable_frame(), this.exports.palpable_frame_size());
      yield kind === textFrame ? new TextDecoder().decode(bytes) : bytes.slice().buffer;
    }
  }

  /** What `palpable probe` gives; throws the sentence of an error. */
  probe(rows: readonly Row[], options: object): number[][] {
    const path = Float64Array.from(rows.flat());
    if (path.length !== 4 * rows.length) throw new Error('each row holds four numbers: t_s, x_m, y_m, z_m');
    const told = new TextEncoder().encode(JSON.stringify(options));
    const at = this.with(told, (words) =>
      this.with(new Uint8Array(path.buffer), (path_at) => this.exports.palpable_probe(words, told.length, path_at, rows.length)),
    );
    if (at === 0) throw new Error(this.sentence());
    const forces = new Float64Array(this.exports.memory.buffer, at, path.length);
    return rows.map((_, i) => [...forces.subarray(4 * i, 4 * i + 4)]);
  }

  private sentence(): string {
    const { memory } = this.exports;
    const from = new Uint8Array(memory.buffer, this.exports.palpable_sentence());
    return new TextDecoder().decode(from.subarray(0, from.indexOf(0)));
  }

  /** Calls with a copy of the bytes in the module's memory. */
  private with<T>(bytes: ArrayLike<number>, use: (at: number) => T): T {
    const at = this.exports.palpable_allocate(bytes.length);
    // The memory may have grown: the view is made anew.
    new Uint8Array(this.exports.memory.buffer).set(bytes, at);
    const result = use(at);
    this.exports.palpable_release(at);
    return result;
  }
}
