// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Walking in the egocentric view: the explorer moves and turns with this page's probes, and the pose is spoken, sent and
// drawn.
import { t } from '../language';
import { element } from '../dom';
import { Explorer, type ExplorerPose } from './explorer';
import type { FromPage } from '../generated/protocol';
import type { PageProbes } from './page_probes';
import type { Place, Surface } from '../surface';

/** Metres ahead, degrees to the left. */
export interface Walk {
  ahead: number;
  left: number;
}

export interface WalkingPage {
  surface(): Surface | null;
  say(words: string): void;
  send(message: FromPage): void;
  showPose(pose: ExplorerPose): void;
  arrow(points: Place[]): void;
}

export class Walking {
  private readonly explorer = new Explorer();
  private egocentric = false;

  constructor(
    private readonly probes: PageProbes,
    private readonly page: WalkingPage,
  ) {}

  allow(egocentric: boolean): void {
    this.egocentric = egocentric;
    for (const id of ['walking', 'walk-keys', 'pose-row']) element(id).hidden = !egocentric;
  }

  /** Converts a displacement (x to the explorer's right, y ahead) to the scene's frame. */
  inScene(way: Place): Place {
    return this.explorer.inScene(way);
  }

  walk({ ahead, left }: Walk): void {
    const surface = this.page.surface();
    if (surface === null) return;
    if (!this.egocentric) return this.page.say(t('Walking is for the egocentric view: start with --view egocentric.'));
    const before = this.explorer.pose;
    if (left !== 0) this.explorer.turn(left);
    if (ahead !== 0 && !this.explorer.walk(ahead * surface.scale, surface)) this.page.say(t('The scene ends here.'));
    for (const probe of this.probes.numbers) {
      const moved = this.probes.at(probe)!;
      const place = this.explorer.carried(moved.place, before);
      moved.step(place.x - moved.place.x, place.y - moved.place.y, 0, surface, performance.now());
    }
    this.sendPose();
  }

  sayPose(): void {
    if (!this.egocentric) return this.page.say(t('This is the exocentric view: you look from outside.'));
    this.sendPose();
  }

  reset(): void {
    this.explorer.reset();
  }

  /** Sends the explorer's pose to the program, which says it in words. */
  sendPose(): void {
    if (!this.egocentric) return;
    const { x, y, heading } = this.explorer.pose;
    this.page.send({ type: 'move_explorer', x_m: x, y_m: y, heading_deg: heading });
    this.show();
  }

  show(): void {
    if (!this.egocentric) return;
    this.page.showPose(this.explorer.pose);
    this.page.arrow(this.explorer.arrow(this.page.surface()?.scale ?? 1));
  }
}
