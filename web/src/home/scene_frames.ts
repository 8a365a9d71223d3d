// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Assembles a scene from its parts: description, heights, picture and cells.
import type { HeightsFrame, PictureFrame } from '../codec';
import type { Scene } from '../generated/protocol';
import { Surface, type Place } from '../surface';

export class SceneFrames {
  scene: Scene | null = null;
  surface: Surface | null = null;
  picture: PictureFrame | null = null;
  cells: PictureFrame | null = null;

  /** Takes a frame; false if it belongs to another scene. */
  take(frame: HeightsFrame | PictureFrame): boolean {
    if (this.scene === null || frame.scene !== this.scene.scene) return false;
    if (frame.kind === 'heights') {
      this.surface = new Surface(frame.columns, frame.rows, frame.heights, this.scene.size_x_m, this.scene.size_y_m, this.scene.upright);
      this.picture = this.cells = null;
    } else {
      this[frame.kind] = frame;
    }
    return true;
  }

  /** What is called the middle, and where a probe begins. */
  get middle(): Place {
    return { x: this.scene?.middle_x_m ?? 0, y: this.scene?.middle_y_m ?? 0 };
  }
  get start(): Place {
    return { x: this.scene?.start_x_m ?? 0, y: this.scene?.start_y_m ?? 0 };
  }

  /** Whether all parts of the scene have arrived. */
  get isComplete(): boolean {
    const { scene, surface, picture, cells } = this;
    return scene !== null && surface !== null && (!scene.has_picture || picture !== null) && (scene.cells === null || cells !== null);
  }
}
