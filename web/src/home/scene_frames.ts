// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Assembles a scene from its parts: description, heights, pictures and cells.
import type { PictureFrame, RasterFrame, ShiftFrame } from '../codec';
import type { Scene } from '../generated/protocol';
import { Surface, type Place } from '../surface';
import type { SecondView } from '../view/second_view';

export class SceneFrames {
  scene: Scene | null = null;
  surface: Surface | null = null;
  picture: PictureFrame | null = null;
  cells: PictureFrame | null = null;
  private second: PictureFrame | null = null;
  private shift: ShiftFrame | null = null;

  /** Takes a frame; false if it belongs to another scene. */
  take(frame: RasterFrame): boolean {
    if (this.scene === null || frame.scene !== this.scene.scene) return false;
    if (frame.kind === 'heights') {
      this.surface = new Surface(frame.columns, frame.rows, frame.heights, this.scene.size_x_m, this.scene.size_y_m, this.scene.upright);
      this.picture = this.cells = this.second = this.shift = null;
    } else if (frame.kind === 'shift') {
      this.shift = frame;
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

  /** What the right eye sees; null: the same picture. */
  get secondView(): SecondView | null {
    return this.second && this.shift && { picture: this.second, shift: this.shift };
  }

  /** Whether all parts of the scene have arrived. */
  get isComplete(): boolean {
    const { scene, surface, picture, cells } = this;
    return scene !== null && surface !== null && (!scene.has_picture || picture !== null) && (!scene.has_second_view || this.secondView !== null) && (scene.cells === null || cells !== null);
  }
}
