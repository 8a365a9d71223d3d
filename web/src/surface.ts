// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The relief on the page: heights over a rectangle centred on the origin, x right, y up, z towards the user.

export interface Place {
  x: number;
  y: number;
}

export class Surface {
  private heightRange: { lowest: number; highest: number } | null = null;

  /** `heights`: metres, row-major, origin top-left, which do not change; `sizeX` and `sizeY`: metres along x and y. */
  constructor(
    readonly columns: number,
    readonly rows: number,
    readonly heights: Float32Array,
    readonly sizeX: number,
    readonly sizeY: number,
    /** Whether it is a solid that stands upright, y up: the camera is then above its front, not below it. */
    readonly isUpright = false,
  ) {}

  /**
   * The scene's scale: its longer side in units of 0.1 m, rounded to 1, 2 or 5 times a power of ten. Steps of
   * keys and of walking are multiplied by it.
   */
  get scale(): number {
    const size = Math.max(this.sizeX, this.sizeY) / 0.1;
    const power = 10 ** Math.floor(Math.log10(size));
    const candidates = [1, 2, 5, 10].map((factor) => Number((factor * power).toPrecision(1)));
    return candidates.reduce((best, one) => (Math.abs(Math.log(one / size)) < Math.abs(Math.log(best / size)) ? one : best));
  }

  xOf(column: number): number {
    return ((column + 0.5) / this.columns - 0.5) * this.sizeX;
  }
  yOf(row: number): number {
    return (0.5 - (row + 0.5) / this.rows) * this.sizeY;
  }
  at(column: number, row: number): number {
    const i = Math.min(this.columns - 1, Math.max(0, column));
    const j = Math.min(this.rows - 1, Math.max(0, row));
    return this.heights[j * this.columns + i] ?? 0;
  }

  /** Height at a place, interpolated bilinearly; constant beyond the border. */
  heightAt({ x, y }: Place): number {
    const u = (x / this.sizeX + 0.5) * this.columns - 0.5;
    const v = (0.5 - y / this.sizeY) * this.rows - 0.5;
    const i = Math.floor(u);
    const j = Math.floor(v);
    const [s, t] = [u - i, v - j];
    const top = this.at(i, j) * (1 - s) + this.at(i + 1, j) * s;
    const bottom = this.at(i, j + 1) * (1 - s) + this.at(i + 1, j + 1) * s;
    return top * (1 - t) + bottom * t;
  }

  /** dz/dx and dz/dy, by central differences over two samples. */
  slopeAt({ x, y }: Place): Place {
    const hx = this.sizeX / this.columns;
    const hy = this.sizeY / this.rows;
    return {
      x: (this.heightAt({ x: x + hx, y }) - this.heightAt({ x: x - hx, y })) / (2 * hx),
      y: (this.heightAt({ x, y: y + hy }) - this.heightAt({ x, y: y - hy })) / (2 * hy),
    };
  }

  clamp({ x, y }: Place): Place {
    const within = (value: number, size: number) => Math.min(size / 2, Math.max(-size / 2, value));
    return { x: within(x, this.sizeX), y: within(y, this.sizeY) };
  }

  contains({ x, y }: Place): boolean {
    return Math.abs(x) <= this.sizeX / 2 && Math.abs(y) <= this.sizeY / 2;
  }

  range(): { lowest: number; highest: number } {
    if (this.heightRange !== null) return this.heightRange;
    let [lowest, highest] = [Infinity, -Infinity];
    for (const z of this.heights) {
      lowest = Math.min(lowest, z);
      highest = Math.max(highest, z);
    }
    return (this.heightRange = { lowest, highest });
  }

  /**
   * First intersection of a ray from above with the surface raised by `heightFactor`, or with the base plane
   * if it misses. Null if the ray does not descend.
   */
  hit(origin: [number, number, number], direction: [number, number, number], heightFactor: number): Place | null {
    const [dx, dy, dz] = direction;
    if (dz >= 0) return null;
    const { lowest, highest } = this.range();
    const top = Math.max(0, lowest * heightFactor, highest * heightFactor);
    const bottom = Math.min(0, lowest * heightFactor, highest * heightFactor);
    const begin = Math.max(0, (top - origin[2]) / dz);
    const end = (bottom - origin[2]) / dz;
    const steps = 400;
    const at = (t: number): Place => ({ x: origin[0] + t * dx, y: origin[1] + t * dy });
    for (let k = 0; k <= steps; ++k) {
      const t = begin + ((end - begin) * k) / steps;
      const place = at(t);
      if (this.contains(place) && origin[2] + t * dz <= this.heightAt(place) * heightFactor) return place;
    }
    return at(-origin[2] / dz);
  }
}
