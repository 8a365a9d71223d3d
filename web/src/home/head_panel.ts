// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What follows the head: the browser's camera, or the program's depth camera if it has one; its switch in the depth settings,
// and the view that it moves.
import { t } from '../language';
import { element } from '../dom';
import type { FromPage, Head } from '../generated/protocol';
import { ranges, type Preferences } from '../settings/preferences';
import { RangeInput } from '../settings/range_input';
import { cssPixel } from '../settings/screen_size';
import { restingHead } from '../view/depth/head';
import { openCamera, type CameraFault, type HeadCamera, type Seen } from '../view/head/camera';
import { DepthCamera } from '../view/head/depth_camera';
import { HeadPath, lostAfter } from '../view/head/path';
import { calibrated, calibratedTilt, fitFace, placeOf, type FaceFit, type Lens } from '../view/head/place';
import { faultWords, headCameraWords as words, tiltWords } from '../view/head/words';
import type { Stage } from '../view/stage';
import type { DepthTarget } from './depth_panel';

/** Smaller motions of the head are not drawn, metres. */
const leastMotion = 0.0002;

export interface HeadTarget extends DepthTarget {
  send(message: FromPage): void;
}

const percent = (value: number) => t('{value} %', { value });
const millimetres = (value: number) => t('{value} mm', { value });
const sliders = [
  { id: 'camera-angle', key: 'cameraAngle', words: (value: number) => t('{value}°', { value }) },
  { id: 'camera-tilt', key: 'cameraTilt', words: tiltWords },
  { id: 'camera-above', key: 'cameraAbove', words: millimetres },
  { id: 'camera-right', key: 'cameraRight', words: millimetres },
  { id: 'head-gain-x', key: 'headGainX', words: percent },
  { id: 'head-gain-y', key: 'headGainY', words: percent },
  { id: 'head-gain-z', key: 'headGainZ', words: percent },
] as const;

export class HeadPanel {
  private readonly input = element<HTMLInputElement>('follow-head');
  private camera: HeadCamera | null = null;
  private depth: DepthCamera | null = null;
  /** Whether the program has a depth camera, which is used instead of the browser's; null before it has told. */
  private byDepth: boolean | null = null;
  private path = new HeadPath();
  private face: { fit: FaceFit; lens: Lens } | null = null;
  /** Whether the head is followed now. */
  private seen = false;
  private severalSaid = false;
  private lostWords: string = words.lost;
  private shown = restingHead;
  private readonly ranges: RangeInput[];

  constructor(
    private readonly stage: Stage,
    private readonly target: HeadTarget,
  ) {
    this.ranges = sliders.map(({ id, key }) => new RangeInput(id, (value) => target.change({ [key]: value } as Partial<Preferences>, id)));
    this.input.addEventListener('change', () => (this.input.checked ? this.start() : this.stop(this.offWords)));
    element('head-straight').addEventListener('click', () => this.calibrate());
    window.addEventListener('pagehide', () => this.camera?.stop());
    this.follow();
  }

  /** Call it when the settings have changed. */
  follow(): void {
    const page = this.target.page();
    const { isFlat } = this;
    const disabled = (key: string) => (isFlat ? t('in 3D only') : this.byDepth === true && key === 'cameraAngle' ? words.depthAngle : null);
    sliders.forEach(({ key, words: its }, k) => this.ranges[k]!.show({ ...ranges[key], value: page[key], words: its, disabled: disabled(key) }));
    this.input.disabled = isFlat;
    this.depth?.tilted(page.cameraTilt);
    if (this.runs && (isFlat || page.depthMode === 'plain')) this.stop(this.offWords);
  }

  /** The program was met, again perhaps. With a depth camera, for which a person has asked it, the head is followed at once. */
  greet(findsHead: boolean): void {
    const isFirst = this.byDepth === null;
    if (this.byDepth !== findsHead && this.runs) this.stop(this.offWords);
    this.byDepth = findsHead;
    this.depth?.ask();
    if (!findsHead) return;
    element('follow-head-name').textContent = words.depthHead;
    element('head-privacy').textContent = words.depthPrivacy;
    element('head-straight-words').textContent = words.depthStraight;
    this.follow();
    if (!isFirst || this.isFlat) return;
    this.input.checked = true;
    this.start();
  }

  /** What the depth camera sees. */
  receive(head: Head): void {
    const { depth } = this;
    if (depth === null) return;
    if (head.pictures === 'ended') return this.stop(words.depthEnded);
    const time = depth.timeOf(head);
    if (head.pictures === 'missing') return this.miss(words.depthMissing);
    this.lostWords = words.lost;
    this.sayIfSeveral(head.heads, words.severalHeads);
    depth.from = head.place && { x: head.place.x_m, y: head.place.y_m, z: head.place.z_m };
    if (depth.from === null) return this.path.miss(time);
    const { up, right } = this.cameraPlace();
    this.path.add(time, { x: right + depth.from.x, y: up + depth.from.y, z: depth.from.z });
  }

  /** The program is not connected: nothing more comes from it. */
  programLost(): void {
    if (this.depth !== null) this.miss(null);
  }

  private miss(sentence: string | null): void {
    this.lostWords = sentence ?? words.lost;
    this.path.miss(performance.now() + lostAfter);
    if (sentence !== null && !this.seen) this.tell(sentence);
  }

  private get isFlat(): boolean {
    return this.target.page().view === 'flat' || element<HTMLSelectElement>('view').disabled;
  }
  private get runs(): boolean {
    return this.camera !== null || this.depth !== null;
  }
  private get offWords(): string {
    return this.byDepth === true ? words.depthOff : words.off;
  }

  private start(): void {
    if (this.target.page().depthMode === 'plain') this.target.change({ depthMode: 'head' }, 'depthMode');
    this.path = new HeadPath();
    this.face = null;
    this.seen = this.severalSaid = false;
    this.shown = restingHead;
    this.lostWords = words.lost;
    if (this.byDepth === true) {
      this.depth = new DepthCamera((message) => this.target.send(message), this.target.page().cameraTilt);
      this.tell(words.depthStarted);
    } else {
      this.tell(words.waiting);
      this.camera = openCamera({
        started: () => this.tell(words.started),
        seen: (seen) => this.see(seen),
        failed: (fault) => this.fail(fault),
      });
    }
    this.showState();
    this.frame();
  }

  private stop(sentence: string): void {
    this.camera?.stop();
    this.depth?.stop();
    this.camera = this.depth = null;
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
    this.sayIfSeveral(faces, words.several);
    if (points === null) return this.path.miss(time);
    const { cameraAngle: angle, cameraTilt: tilt, eyeDistance } = this.target.page();
    const lens = { width, height, angle, tilt, ...this.cameraPlace() };
    const fit = fitFace(points);
    this.face = { fit, lens };
    this.path.add(time, placeOf(fit, lens, eyeDistance / 1000));
  }

  private sayIfSeveral(count: number, sentence: string): void {
    if (count <= 1 || this.severalSaid) return;
    this.severalSaid = true;
    this.tell(sentence);
  }

  /** Of the camera from the middle of the screen, metres. */
  private cameraPlace(): Pick<Lens, 'up' | 'right'> {
    const { cameraAbove, cameraRight, pixelSize } = this.target.page();
    const screenHeight = (window.screen.height * cssPixel(pixelSize, window.devicePixelRatio)) / 1000;
    return { up: screenHeight / 2 + cameraAbove / 1000, right: cameraRight / 1000 };
  }

  private frame(): void {
    if (!this.runs) return;
    const { screenDistance, headGainX, headGainY, headGainZ } = this.target.page();
    const now = performance.now();
    const seen = this.path.isSeen;
    if (seen !== this.seen) {
      this.seen = seen;
      this.showState();
      this.tell(seen ? words.found : this.lostWords);
    }
    const head = this.path.at(now, screenDistance / 1000, { x: headGainX / 100, y: headGainY / 100, z: headGainZ / 100 });
    if (Math.hypot(head.x - this.shown.x, head.y - this.shown.y, head.z - this.shown.z) > leastMotion) {
      this.shown = head;
      this.stage.moveHead(head);
    }
    requestAnimationFrame(() => this.frame());
  }

  private calibrate(): void {
    const { face, depth } = this;
    if (depth !== null) return this.calibrateDepth(depth);
    if (face === null || !this.path.isSeen) return this.target.say(words.unseen);
    const { screenDistance, eyeDistance } = this.target.page();
    const found = calibrated(face.fit, face.lens, eyeDistance / 1000, screenDistance / 1000);
    if (found === null) return this.target.say(words.implausible);
    this.target.change({ cameraAngle: Number(found.angle.toFixed(1)), cameraTilt: Number(found.tilt.toFixed(1)) }, 'cameraAngle');
    this.target.say(words.calibrated);
  }

  private calibrateDepth({ from, tilt }: DepthCamera): void {
    if (from === null || !this.path.isSeen) return this.target.say(words.unseen);
    const found = calibratedTilt(from, tilt, this.cameraPlace().up);
    if (found === null) return this.target.say(words.implausibleTilt);
    this.target.change({ cameraTilt: Number(found.toFixed(1)) }, 'cameraTilt');
    this.target.say(words.calibrated);
  }

  private showState(): void {
    element<HTMLButtonElement>('head-straight').disabled = !this.runs;
    document.documentElement.dataset.head = !this.runs ? 'off' : this.seen ? 'seen' : 'looked for';
  }
  private tell(sentence: string): void {
    element('head-words').textContent = sentence;
    this.target.say(sentence);
  }
}
