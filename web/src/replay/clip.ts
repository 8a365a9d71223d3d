// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Records a canvas, with sound, as a WebM file by the browser's own encoder.
import { withDuration } from './webm_duration';

const types = ['video/webm;codecs=vp9,opus', 'video/webm;codecs=vp8,opus', 'video/webm'];
const framesPerSecond = 30;
/** Milliseconds of video that are handed over at a time, so that the browser can put them on the disk. */
const piece = 1000;

/** The type that this browser records; null: none. */
export function clipType(): string | null {
  if (typeof MediaRecorder === 'undefined' || typeof HTMLCanvasElement.prototype.captureStream !== 'function') return null;
  return types.find((type) => MediaRecorder.isTypeSupported(type)) ?? null;
}

export class Clip {
  private readonly recorder: MediaRecorder;
  private readonly stream: MediaStream;
  private readonly pieces: Blob[] = [];

  /** Begins. `sound`: null for none. Throws if the browser refuses. */
  constructor(canvas: HTMLCanvasElement, sound: MediaStream | null, type: string) {
    this.stream = canvas.captureStream(framesPerSecond);
    this.recorder = new MediaRecorder(new MediaStream([...this.stream.getVideoTracks(), ...(sound?.getAudioTracks() ?? [])]), { mimeType: type });
    this.recorder.addEventListener('dataavailable', ({ data }) => data.size > 0 && this.pieces.push(data));
    this.recorder.start(piece);
  }

  /** While the page is hidden it draws nothing. */
  pause(paused: boolean): void {
    if (paused && this.recorder.state === 'recording') this.recorder.pause();
    if (!paused && this.recorder.state === 'paused') this.recorder.resume();
  }

  /** Ends it: the file. */
  async finish(): Promise<Blob> {
    await new Promise<void>((resolve) => {
      if (this.recorder.state === 'inactive') return resolve();
      this.recorder.addEventListener('stop', () => resolve(), { once: true });
      this.recorder.stop();
    });
    for (const track of this.stream.getTracks()) track.stop();
    const recorded = new Uint8Array(await new Blob(this.pieces).arrayBuffer());
    return new Blob([withDuration(recorded)], { type: 'video/webm' });
  }
}
