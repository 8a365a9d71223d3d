// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The browser's camera, and the faces in its pictures. Nothing of a picture is kept or sent.
import type { Found, Look } from './face_worker';
import type { FacePoints } from './place';

export type CameraFault = 'refused' | 'missing' | 'busy' | 'insecure' | 'ended' | 'frozen' | 'no finder';

/** A face in a picture of the camera. */
export interface Seen {
  /** When the picture was taken, by performance.now(). */
  time: number;
  /** Of the picture, pixels. */
  width: number;
  height: number;
  /** Null: no face. */
  points: FacePoints | null;
  /** How many faces there were when the whole picture was searched last. */
  faces: number;
}

export interface CameraTarget {
  started(): void;
  seen(seen: Seen): void;
  failed(fault: CameraFault): void;
}

export interface HeadCamera {
  /** Its light goes out. */
  stop(): void;
}

/** Without a picture for so long, while the page is visible, the camera is taken to be frozen (milliseconds). */
const frozenAfter = 3000;
const wanted = { width: { ideal: 640 }, height: { ideal: 480 }, frameRate: { ideal: 30 }, facingMode: 'user' };

/** Asks for the camera and follows the face in its pictures until it is stopped or fails. */
export function openCamera(target: CameraTarget): HeadCamera {
  return new Camera(target);
}

class Camera implements HeadCamera {
  private readonly video = document.createElement('video');
  private readonly worker = new Worker(new URL('./face_worker.ts', import.meta.url), { type: 'module' });
  private stream: MediaStream | null = null;
  private stopped = false;
  /** Whether the worker has a picture. */
  private busy = true;
  private pictureAt = 0;
  private watch: number | undefined;

  constructor(private readonly target: CameraTarget) {
    this.worker.addEventListener('message', ({ data }: MessageEvent<Found>) => this.found(data));
    this.worker.addEventListener('error', () => this.fail('no finder'));
    // After the caller has the camera, which a failure ends.
    queueMicrotask(() => void this.open());
  }

  stop(): void {
    this.stopped = true;
    clearInterval(this.watch);
    this.worker.terminate();
    for (const track of this.stream?.getTracks() ?? []) track.stop();
    this.video.srcObject = null;
  }

  private async open(): Promise<void> {
    // Pages of other machines without TLS have no camera.
    if (navigator.mediaDevices === undefined) return this.fail('insecure');
    if (!('requestVideoFrameCallback' in this.video)) return this.fail('no finder');
    try {
      this.stream = await navigator.mediaDevices.getUserMedia({ video: wanted, audio: false });
    } catch (error) {
      return this.fail(faultOf(error));
    }
    if (this.stopped) return this.stop();
    for (const track of this.stream.getTracks()) track.addEventListener('ended', () => this.fail('ended'));
    this.video.muted = true;
    this.video.srcObject = this.stream;
    await this.video.play().catch(() => undefined);
    this.pictureAt = performance.now();
    this.watch = window.setInterval(() => this.check(), frozenAfter / 3);
    this.next();
  }

  private check(): void {
    if (document.hidden) this.pictureAt = performance.now();
    else if (performance.now() - this.pictureAt > frozenAfter) this.fail('frozen');
  }

  private next(): void {
    this.video.requestVideoFrameCallback((now, { captureTime }) => {
      if (this.stopped) return;
      this.pictureAt = performance.now();
      // Pictures that come while the worker is busy are left out: the next one is newer.
      if (!this.busy) void this.look(captureTime ?? now);
      this.next();
    });
  }

  private async look(time: number): Promise<void> {
    this.busy = true;
    try {
      const picture = await createImageBitmap(this.video);
      const look: Look = { picture, time };
      this.worker.postMessage(look, [picture]);
    } catch {
      this.busy = false;
    }
  }

  private found(message: Found): void {
    if (this.stopped) return;
    if (message.type === 'failed') return this.fail('no finder');
    this.busy = false;
    if (message.type === 'ready') this.target.started();
    else this.target.seen(message);
  }

  private fail(fault: CameraFault): void {
    if (this.stopped) return;
    this.stop();
    this.target.failed(fault);
  }
}

function faultOf(error: unknown): CameraFault {
  const name = error instanceof DOMException ? error.name : '';
  if (name === 'NotAllowedError' || name === 'SecurityError') return 'refused';
  return name === 'NotFoundError' || name === 'OverconstrainedError' ? 'missing' : 'busy';
}
