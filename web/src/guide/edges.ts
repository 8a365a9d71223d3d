// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Where a surface is steep enough for the sound of an edge, to lead a beginner there.
import type { Place, Surface } from '../surface';

/** The slope from which an edge sounds (sound/sonify.ts). */
const steep = 0.8;
/** Most places that are kept: a search looks at each of them. */
const most = 20_000;

export class Edges {
  private readonly places: Place[] = [];
  /** The highest place. */
  readonly top: Place = { x: 0, y: 0 };

  constructor(surface: Surface, heightFactor: number) {
    let highest = -Infinity;
    const every = Math.max(1, Math.ceil(Math.sqrt((surface.columns * surface.rows) / (8 * most))));
    for (let row = 1; row < surface.rows - 1; row += every)
      for (let column = 1; column < surface.columns - 1; column += every) {
        const place = { x: surface.xOf(column), y: surface.yOf(row) };
        const height = surface.at(column, row) * heightFactor;
        if (height > highest) [highest, this.top] = [height, place];
        const slope = surface.slopeAt(place);
        if (Math.hypot(slope.x, slope.y) * Math.abs(heightFactor) > steep) this.places.push(place);
      }
    const thin = Math.ceil(this.places.length / most);
    if (thin > 1) this.places = this.places.filter((_, k) => k % thin === 0);
  }

  get areThere(): boolean {
    return this.places.length > 0;
  }

  /** The edge that is nearest to a place; null: there is none. */
  nearest({ x, y }: Place): Place | null {
    let [best, least]: [Place | null, number] = [null, Infinity];
    for (const place of this.places) {
      const away = (place.x - x) ** 2 + (place.y - y) ** 2;
      if (away < least) [best, least] = [place, away];
    }
    return best;
  }
}
