// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The egocentric frame of reference: the explorer's pose in the scene.
import type { Place, Surface } from '../surface';

export const pace = 0.005;
export const turnBy = 15;

/** Degrees: 0 faces up the scene, to the left is positive. */
export interface ExplorerPose extends Place {
  heading: number;
}

const turned = ({ x, y }: Place, degrees: number): Place => {
  const angle = (degrees * Math.PI) / 180;
  return { x: x * Math.cos(angle) - y * Math.sin(angle), y: x * Math.sin(angle) + y * Math.cos(angle) };
};

export class Explorer {
  private now: ExplorerPose = { x: 0, y: 0, heading: 0 };

  get pose(): ExplorerPose {
    return this.now;
  }

  /** Converts a displacement (x to the explorer's right, y ahead) to the scene's frame. */
  inScene(way: Place): Place {
    return turned(way, this.now.heading);
  }

  /** Walks ahead (metres; negative: back), clamped to the scene. False at its rim. */
  walk(ahead: number, surface: Surface): boolean {
    const way = this.inScene({ x: 0, y: ahead });
    const wanted = { x: this.now.x + way.x, y: this.now.y + way.y };
    const place = surface.clamp(wanted);
    this.now = { ...this.now, ...place };
    return Math.hypot(place.x - wanted.x, place.y - wanted.y) < 1e-9;
  }

  /** Turns left by this angle in degrees; negative: right. */
  turn(degrees: number): void {
    const heading = this.now.heading + degrees;
    this.now = { ...this.now, heading: heading - 360 * Math.ceil((heading - 180) / 360) };
  }

  reset(): void {
    this.now = { x: 0, y: 0, heading: 0 };
  }

  /** The new place of a hand that moves with the explorer, from its place at an earlier pose. */
  carried(hand: Place, before: ExplorerPose): Place {
    const held = turned({ x: hand.x - before.x, y: hand.y - before.y }, -before.heading);
    const way = this.inScene(held);
    return { x: this.now.x + way.x, y: this.now.y + way.y };
  }

  /** An arrow from the explorer's place in the direction of the heading, for drawing on the scene. */
  arrow(scale = 1): Place[] {
    const shape: Place[] = [{ x: 0, y: 0 }, { x: 0, y: 0.008 }, { x: -0.0025, y: 0.005 }, { x: 0, y: 0.008 }, { x: 0.0025, y: 0.005 }];
    return shape.map((corner) => {
      const way = this.inScene({ x: corner.x * scale, y: corner.y * scale });
      return { x: this.now.x + way.x, y: this.now.y + way.y };
    });
  }
}
