// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Plays the values of sonify.ts: a tone for the height, a click for contact, a short tone for an edge.

const toneLevel = 0.25;
/** The tone fades out after the probe has rested this long (s): silence means no motion. */
const restTime = 1.2;
/** Audio is suspended after this long without a sound (s), since a running context costs processor time even in silence. */
const suspendTime = 4;

interface Tone {
  oscillator: OscillatorNode;
  gain: GainNode;
  pan: StereoPannerNode;
}

export class Sound {
  private context: AudioContext | null = null;
  private master: GainNode | null = null;
  /** One tone for each probe. */
  private readonly tones = new Map<number, Tone>();
  private on = false;
  private volume = 0.5;
  /** Suspended by suspendTime, not by the browser. */
  private resting = false;
  private timer: ReturnType<typeof setTimeout> | undefined;
  /** How often each sound was played, for tests. */
  readonly played = { clicks: 0, edges: 0 };

  /** Whether sounds can be heard. */
  get runs(): boolean {
    return this.resting || this.context?.state === 'running';
  }

  /** Browsers start audio only after a user action: call this from such an event. */
  async wake(): Promise<void> {
    if (!this.on || typeof AudioContext === 'undefined') return;
    if (this.context === null) this.build(new AudioContext());
    if (this.context?.state === 'suspended') await this.context.resume();
    this.stayAwake();
  }

  /** @param volume loudness of all sounds, 0 ... 100 */
  set(on: boolean, volume: number): void {
    this.on = on;
    this.volume = volume / 100;
    this.level();
  }

  /**
   * Plays the tone of a probe's place; several tones share the loudness of one.
   * @param pitch frequency, Hz
   * @param pan -1 (left) ... 1 (right)
   */
  height(probe: number, pitch: number, pan: number): void {
    if (!this.on || this.context === null || this.master === null) return;
    this.stayAwake();
    const tone = this.tones.get(probe) ?? this.begin(probe, this.context, this.master);
    const now = this.context.currentTime;
    tone.oscillator.frequency.setTargetAtTime(pitch, now, 0.012);
    tone.pan.pan.setTargetAtTime(pan, now, 0.02);
    tone.gain.gain.cancelScheduledValues(now);
    tone.gain.gain.setTargetAtTime(toneLevel / Math.sqrt(this.tones.size), now, 0.02);
    tone.gain.gain.setTargetAtTime(0, now + restTime, 0.15);
  }

  /** Ends the tones of removed probes: of all but these. */
  removeTonesExcept(numbers: readonly number[]): void {
    for (const [probe, tone] of this.tones) {
      if (numbers.includes(probe) || this.context === null) continue;
      this.tones.delete(probe);
      tone.gain.gain.cancelScheduledValues(this.context.currentTime);
      tone.gain.gain.setTargetAtTime(0, this.context.currentTime, 0.02);
      tone.oscillator.onended = () => tone.pan.disconnect();
      tone.oscillator.stop(this.context.currentTime + 0.2);
    }
  }

  /** The sound of contact. @param pan -1 (left) ... 1 (right) */
  click(pan: number): void {
    this.played.clicks += 1;
    this.blip('square', 140, 0.018, 0.5, pan);
  }

  /** The sound of an edge that is crossed. @param pan -1 (left) ... 1 (right) */
  edge(pan: number): void {
    this.played.edges += 1;
    this.blip('triangle', 1568, 0.06, 0.35, pan);
  }

  /** Resumes audio for a sound, and suspends it when none has followed. */
  private stayAwake(): void {
    const { context } = this;
    if (context === null) return;
    if (this.resting) void context.resume();
    this.resting = false;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      if (context.state !== 'running') return;
      this.resting = true;
      void context.suspend();
    }, 1000 * suspendTime);
  }

  private build(context: AudioContext): void {
    this.context = context;
    this.master = context.createGain();
    this.master.connect(context.destination);
    this.level();
  }

  private begin(probe: number, context: AudioContext, master: GainNode): Tone {
    const oscillator = new OscillatorNode(context, { type: 'sine', frequency: 220 });
    const gain = new GainNode(context, { gain: 0 });
    const pan = new StereoPannerNode(context);
    oscillator.connect(gain).connect(pan).connect(master);
    oscillator.start();
    const tone = { oscillator, gain, pan };
    this.tones.set(probe, tone);
    return tone;
  }

  private level(): void {
    if (this.context && this.master)
      this.master.gain.setTargetAtTime(this.on ? this.volume ** 2 : 0, this.context.currentTime, 0.02);
  }

  private blip(type: OscillatorType, frequency: number, seconds: number, level: number, where: number): void {
    const { context, master } = this;
    if (!this.on || context === null || master === null) return;
    this.stayAwake();
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
