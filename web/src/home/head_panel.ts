// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The camera that follows the head: its switch in the depth settings, and the view that it moves.
import { t } from '../language';
import { element } from '../dom';
import { ranges, type Preferences } from '../settings/preferences';
import { RangeInput } from '../settings/range_input';
import { cssPixel } from '../settings/screen_size';
import { restingHead } from '../view/depth/head';
import { openCamera, type CameraFault, type HeadCamera, type Seen } from '../view/head/camera';
import { HeadPath } from '../view/head/path';
import { calibrated, fitFace, placeOf, type FaceFit, type Lens } from '../view/head/place';
import { faultWords, headCameraWords as words, tiltWords } from '../view/head/words';
import type { Stage } from '../view/stage';
import type { DepthTarget } from './depth_panel';

/** Smaller motions of the head are not drawn, metres. */
const leastMotion = 0.0002;

const percent = (value: number) => t('{value} %', { value });
const sliders = [
  { id: 'camera-angle', key: 'cameraAngle', words: (value: number) => t('{value}°', { value }) },
  { id: 'camera-tilt', key: 'cameraTilt', words: tiltWords },
  { id: 'camera-above', key: 'cameraAbove', words: (value: number) => t('{value} mm', { value }) },
  { id: 'head-gain-x', key: 'headGainX', words: percent },
  { id: 'head-gain-y', key: 'headGainY', words: percent },
  { id: 'head-gain-z', key: 'headGainZ', words: percent },
] as const;

export class HeadPanel {
  private readonly input = element<HTMLInputElement>('follow-head');
  private camera: HeadCamera | null = null;
  private path = new HeadPath();
  private face: { fit: FaceFit; lens: Lens } | null = null;
  /** Whether the head is followed now. */
  private seen = false;
  private severalSaid = false;
  private shown = restingHead;
  private readonly ranges: RangeInput[];

  constructor(
    private readonly stage: Stage,
    private readonly target: DepthTarget,
  ) {
    this.ranges = sliders.map(({ id, key }) => new RangeInput(id, (value) => target.change({ [key]: value } as Partial<Preferences>, id)));
    this.input.addEventListener('change', () => (this.input.checked ? this.start() : this.stop(words.off)));
    element('head-straight').addEventListener('click', () => this.calibrate());
    window.addEventListener('pagehide', () => this.camera?.stop());
    this.follow();
  }

  /** Call it when the settings have changed. */
  follow(): void {
    const page = this.target.page();
    const isFlat = page.view === 'flat' || element<HTMLSelectElement>('view').disabled;
    sliders.forEach(({ key, words: its }, k) => this.ranges[k]!.show({ ...ranges[key], value: page[key], words: its, disabled: isFlat ? t('in 3D only') : null }));
    this.input.disabled = isFlat;
    if (this.camera !== null && (isFlat || page.depthMode === 'plain')) this.stop(words.off);
  }

  private start(): void {
    if (this.target.page().depthMode === 'plain') this.target.change({ depthMode: 'head' }, 'depthMode');
    this.path = new HeadPath();
    this.face = null;
    this.seen = this.severalSaid = false;
    this.shown = restingHead;
    this.tell(words.waiting);
    this.camera = openCamera({
      started: () => this.tell(words.started),
      seen: (seen) => this.see(seen),
      failed: (fault) => this.fail(fault),
    });
    this.showState();
    this.frame();
  }

  private stop(sentence: string): void {
    this.camera?.stop();
    this.camera = null;
    this.input.checked = false;
    this.showState();
    this.stage.moveHead(restingHead);
    this.tell(sentence);
  }

  private fail(fault: CameraFault): void {
    this.camera = null;
    this.stop(faultWords[fault]);
  }

  private see({ time, width, height, points, faces }: Seen): void {
    if (faces > 1 && !this.severalSaid) {
      this.severalSaid = true;
      this.tell(words.several);
    }
    if (points === null) return this.path.miss(time);
    const { cameraAngle: angle, cameraTilt: tilt, cameraAbove, eyeDistance, pixelSize } = this.target.page();
    const screenHeight = (window.screen.height * cssPixel(pixelSize, window.devicePixelRatio)) / 1000;
    const lens = { width, height, angle, tilt, up: screenHeight / 2 + cameraAbove / 1000 };
    const fit = fitFace(points);
    this.face = { fit, lens };
    this.path.add(time, placeOf(fit, lens, eyeDistance / 1000));
  }

  private frame(): void {
    if (this.camera === null) return;
    const { screenDistance, headGainX, headGainY, headGainZ } = this.target.page();
    const now = performance.now();
    const seen = this.path.isSeen;
    if (seen !== this.seen) {
      this.seen = seen;
      this.showState();
      this.tell(seen ? words.found : words.lost);
    }
    const head = this.path.at(now, screenDistance / 1000, { x: headGainX / 100, y: headGainY / 100, z: headGainZ / 100 });
    if (Math.hypot(head.x - this.shown.x, head.y - this.shown.y, head.z - this.shown.z) > leastMotion) {
      this.shown = head;
      this.stage.moveHead(head);
    }
    requestAnimationFrame(() => this.frame());
  }

  private calibrate(): void {
    const { face } = this;
    if (face === null || !this.path.isSeen) return this.target.say(words.unseen);
    const { screenDistance, eyeDistance } = this.target.page();
    const found = calibrated(face.fit, face.lens, eyeDistance / 1000, screenDistance / 1000);
    if (found === null) return this.target.say(words.implausible);
    this.target.change({ cameraAngle: Number(found.angle.toFixed(1)), cameraTilt: Number(found.tilt.toFixed(1)) }, 'cameraAngle');
    this.target.say(words.calibrated);
  }

  private showState(): void {
    element<HTMLButtonElement>('head-straight').disabled = this.camera === null;
    document.documentElement.dataset.head = this.camera === null ? 'off' : this.seen ? 'seen' : 'looked for';
  }
  private tell(sentence: string): void {
    element('head-words').textContent = sentence;
    this.target.say(sentence);
  }
}
