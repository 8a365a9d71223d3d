// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Plays what sonify.ts works out: a tone that carries the height, a click for contact, a short tone for an edge.

const toneLevel = 0.25;
/** The tone fades out when the probe has rested so long (s): silence means that nothing moves. */
const restTime = 1.2;

export class Sound {
  private context: AudioContext | null = null;
  private master: GainNode | null = null;
  private tone: { oscillator: OscillatorNode; gain: GainNode; pan: StereoPannerNode } | null = null;
  private on = false;
  private volume = 0.5;
  /** How often each was played; the tests listen to these. */
  readonly played = { clicks: 0, edges: 0 };

  /** Browsers let sound begin only after the person did something: call this from such an event. */
  wake(): void {
    if (!this.on || typeof AudioContext === 'undefined') return;
    if (this.context === null) this.build(new AudioContext());
    if (this.context?.state === 'suspended') void this.context.resume();
  }

  set(on: boolean, volume: number): void {
    this.on = on;
    this.volume = volume / 100;
    this.level();
  }

  /** The tone for where the probe is now. */
  height(pitch: number, pan: number): void {
    if (!this.on || this.context === null || this.tone === null) return;
    const now = this.context.currentTime;
    this.tone.oscillator.frequency.setTargetAtTime(pitch, now, 0.012);
    this.tone.pan.pan.setTargetAtTime(pan, now, 0.02);
    this.tone.gain.gain.cancelScheduledValues(now);
    this.tone.gain.gain.setTargetAtTime(toneLevel, now, 0.02);
    this.tone.gain.gain.setTargetAtTime(0, now + restTime, 0.15);
  }

  click(pan: number): void {
    this.played.clicks += 1;
    this.blip('square', 140, 0.018, 0.5, pan);
  }

  edge(pan: number): void {
    this.played.edges += 1;
    this.blip('triangle', 1568, 0.06, 0.35, pan);
  }

  private build(context: AudioContext): void {
    this.context = context;
    this.master = context.createGain();
    this.master.connect(context.destination);
    this.level();
    const oscillator = new OscillatorNode(context, { type: 'sine', frequency: 220 });
    const gain = new GainNode(context, { gain: 0 });
    const pan = new StereoPannerNode(context);
    oscillator.connect(gain).connect(pan).connect(this.master);
    oscillator.start();
    this.tone = { oscillator, gain, pan };
  }

  private level(): void {
    if (this.context && this.master)
      this.master.gain.setTargetAtTime(this.on ? this.volume ** 2 : 0, this.context.currentTime, 0.02);
  }

  private blip(type: OscillatorType, frequency: number, seconds: number, level: number, where: number): void {
    const { context, master } = this;
    if (!this.on || context === null || master === null) return;
    const now = context.currentTime;
    const gain = new GainNode(context, { gain: level });
    gain.gain.setTargetAtTime(0, now, seconds / 3);
    const oscillator = new OscillatorNode(context, { type, frequency });
    const pan = new StereoPannerNode(context, { pan: where });
    oscillator.connect(gain).connect(pan).connect(master);
    oscillator.start();
    oscillator.stop(now + seconds * 3);
    oscillator.onended = () => pan.disconnect();
  }
}
