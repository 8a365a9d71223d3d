// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The audio output: an instrument for each probe, placed in space for two ears, and the volumes.
import { t } from '../language';
import type { Preferences } from '../settings/preferences';
import { soundKinds, type Command, type Levels } from './instrument/instrument';
import { OutputPace, playbackStatsOf } from './output_pace';
import { loadPlayers, type MakePlayer, type Player } from './players';
import type { Direction } from './sonify';

/** Audio is suspended after this long without a sound (s), since a running context costs processor time even in silence. */
const suspendTime = 4;
/** A removed probe's sounds fade for this long (s). */
const endTime = 0.5;
/** Commands that wait while the instrument is loaded; older ones are dropped. */
const mostWaiting = 64;
/** After a key or a click, audio runs within this time (ms), or there is no output for it. */
const startTime = 2000;

/** What is said, each once. */
export const sentences = {
  none: t('This browser plays no sound: height and edges are told by words only.'),
  refused: t('Sound does not start: no audio output was found. Height and edges are told by words.'),
  waits: t('Sound waits for a key press or a click on this page.'),
};

interface Voice {
  player: Player;
  panner: PannerNode;
}

export class Sound {
  private context: AudioContext | null = null;
  private master: GainNode | null = null;
  /** What is heard, after the limit. */
  private output: AudioNode | null = null;
  private tapped: MediaStreamAudioDestinationNode | null = null;
  private make: MakePlayer | null = null;
  /** By probe; the list's examples have a voice of their own. */
  private readonly voices = new Map<number, Voice>();
  /** The material that each probe touches, also while sound is off or not started. */
  private readonly materials = new Map<number, Command>();
  private waiting: [number, Command, Direction | null][] = [];
  private on = false;
  private volume = 0.5;
  private levels: Levels = { contact: 1, slide: 1, height: 1, edge: 1, name: 1, find: 1 };
  /** Suspended by suspendTime, not by the browser. */
  private resting = false;
  /** A user action has asked for audio, which does not run yet. */
  private starting = false;
  private timer: ReturnType<typeof setTimeout> | undefined;
  /** Null: the latency is one that slow machines keep up with. */
  private pace: OutputPace | null = new OutputPace();
  private readonly told = new Set<string>();

  constructor(private readonly tell: (sentence: string) => void) {}

  /** Whether the person wants sounds. */
  get isOn(): boolean {
    return this.on;
  }
  /** Whether sounds can be heard. */
  get runs(): boolean {
    return this.resting || this.context?.state === 'running';
  }
  /** The context's time, s; 0 before audio was started. */
  get now(): number {
    return this.context?.currentTime ?? 0;
  }

  /** Browsers start audio only after a user action: call this from such an event. */
  async wake(): Promise<void> {
    if (!this.on) return;
    if (typeof AudioContext === 'undefined') return this.tellOnce('none');
    if (this.context === null && !this.build()) return;
    if (this.context?.state === 'suspended') await this.resume(this.context);
    this.stayAwake();
  }

  set({ sound, volume, contactVolume, slideVolume, heightVolume, edgeVolume, nameVolume, findVolume }: Preferences): void {
    this.on = sound;
    this.volume = volume / 100;
    const amplitude = (percent: number) => (percent / 100) ** 2;
    this.levels = {
      contact: amplitude(contactVolume),
      slide: amplitude(slideVolume),
      height: amplitude(heightVolume),
      edge: amplitude(edgeVolume),
      name: amplitude(nameVolume),
      find: amplitude(findVolume),
    };
    for (const { player } of this.voices.values()) player.send({ what: 'levels', levels: this.levels });
    this.level();
  }

  /** A probe sounds; `from`: where it is heard, null if that has not changed. */
  play(probe: number, command: Command, from: Direction | null = null): void {
    if (command.what === 'material') this.materials.set(probe, command);
    if (!this.on) return command.what === 'material' ? this.voices.get(probe)?.player.send(command) : undefined;
    if (command.what === 'slide' && command.speed > 0 && !this.runs && !this.starting) this.tellOnce('waits');
    // Not for what is timed by the context's own clock.
    if (command.at === undefined && this.context !== null && this.isTooQuick(this.context)) this.rebuild(this.context);
    const { context, master, make } = this;
    if (context === null) return;
    if ((soundKinds as readonly string[]).includes(command.what)) this.stayAwake();
    if (master === null || make === null) {
      this.waiting = [...this.waiting.slice(1 - mostWaiting), [probe, command, from]];
      return;
    }
    const voice = this.voices.get(probe) ?? this.begin(probe, context, master, make);
    if (from !== null) place(voice.panner, from, command.at ?? context.currentTime);
    voice.player.send(command);
  }

  /** What is heard, as a stream, until untap(); null if nothing can be heard. Call it from a user action. */
  async tap(): Promise<MediaStream | null> {
    await this.wake();
    const { context, output } = this;
    if (!this.on || context === null || output === null) return null;
    this.untap();
    this.tapped = new MediaStreamAudioDestinationNode(context);
    output.connect(this.tapped);
    return this.tapped.stream;
  }
  untap(): void {
    if (this.tapped === null) return;
    this.output?.disconnect(this.tapped);
    this.tapped = null;
    this.stayAwake();
  }

  /** Ends the sounds of removed probes: of all but these. */
  removeProbesExcept(numbers: readonly number[]): void {
    for (const probe of this.materials.keys()) if (!numbers.includes(probe) && probe >= 0) this.materials.delete(probe);
    for (const [probe, { player, panner }] of this.voices) {
      if (numbers.includes(probe) || probe < 0) continue;
      this.voices.delete(probe);
      player.send({ what: 'silence' });
      setTimeout(() => {
        player.end();
        panner.disconnect();
      }, 1000 * endTime);
    }
    this.level();
  }

  private build(): boolean {
    try {
      // The shortest latency that there is, as long as the browser tells whether sound is lost by it.
      this.context = new AudioContext({ latencyHint: this.pace === null ? 'interactive' : 0 });
      if (this.pace !== null && playbackStatsOf(this.context) === null) {
        void this.context.close();
        this.pace = null;
        this.context = new AudioContext({ latencyHint: 'interactive' });
      }
    } catch {
      // No output device, or the browser has too many contexts.
      this.tellOnce('refused');
      return false;
    }
    const { context } = this;
    context.addEventListener('error', () => this.tellOnce('refused'));
    this.master = new GainNode(context, { gain: 0 });
    this.output = this.master.connect(new WaveShaperNode(context, { curve: softLimit() }));
    this.output.connect(context.destination);
    this.level();
    void loadPlayers(context, (onset) => showOnset(context, onset)).then((make) => {
      if (this.context !== context) return;
      this.make = make;
      for (const [probe, command, from] of this.waiting.splice(0)) this.play(probe, command, from);
    });
    return true;
  }

  /** Whether sound is lost by the shortest latency. A recorded one goes on. */
  private isTooQuick(context: AudioContext): boolean {
    const stats = this.tapped === null ? playbackStatsOf(context) : null;
    return stats !== null && this.pace !== null && this.pace.losesSound(stats);
  }

  /** Sound goes on with a longer latency; what sounds at this moment ends. */
  private rebuild(context: AudioContext): void {
    this.pace = null;
    for (const { player } of this.voices.values()) player.end();
    this.voices.clear();
    this.make = null;
    void context.close();
    if (this.build() && this.context !== null) void this.resume(this.context);
  }

  private async resume(context: AudioContext): Promise<void> {
    this.starting = true;
    const late = new Promise<void>((resolve) => setTimeout(resolve, startTime));
    await Promise.race([context.resume().catch(() => undefined), late]);
    this.starting = false;
    // Without a user action a browser holds it back: that is no fault.
    if (context.state === 'suspended' && !this.resting && navigator.userActivation?.hasBeenActive !== false) this.tellOnce('refused');
  }

  /** Resumes audio for a sound, and suspends it when none has followed. */
  private stayAwake(): void {
    const { context } = this;
    if (context === null) return;
    if (this.resting) void context.resume();
    this.resting = false;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      if (context.state !== 'running' || this.tapped !== null) return;
      this.resting = true;
      void context.suspend();
    }, 1000 * suspendTime);
  }

  private begin(probe: number, context: AudioContext, master: GainNode, make: MakePlayer): Voice {
    const material = this.materials.get(probe);
    const player = make([{ what: 'levels', levels: this.levels }, ...(material ? [material] : [])]);
    // As loud from every direction.
    const panner = new PannerNode(context, { panningModel: 'HRTF', distanceModel: 'linear', rolloffFactor: 0, positionZ: -1 });
    player.node.connect(panner).connect(master);
    const voice = { player, panner };
    this.voices.set(probe, voice);
    this.level();
    return voice;
  }

  /** Several probes share the loudness of one. */
  private level(): void {
    const probes = [...this.voices.keys()].filter((probe) => probe >= 0).length;
    const gain = this.on ? this.volume ** 2 / Math.sqrt(Math.max(1, probes)) : 0;
    if (this.context && this.master) this.master.gain.setTargetAtTime(gain, this.context.currentTime, 0.02);
  }

  private tellOnce(which: keyof typeof sentences): void {
    if (this.told.has(which)) return;
    this.told.add(which);
    this.tell(sentences[which]);
  }
}

function place({ positionX, positionY, positionZ }: PannerNode, { x, y, z }: Direction, at: number): void {
  positionX.setTargetAtTime(x, at, 0.02);
  positionY.setTargetAtTime(y, at, 0.02);
  positionZ.setTargetAtTime(z, at, 0.02);
}

/** For measurements: when the newest contact leaves the output (ms of performance.now()), and what of that the output takes (ms); `onset`: s, the context's. */
function showOnset(context: AudioContext, onset: number): void {
  const { contextTime = 0, performanceTime = 0 } = context.getOutputTimestamp();
  const leaves = performanceTime > 0 ? performanceTime + 1000 * (onset - contextTime) : performance.now() + 1000 * (onset - context.currentTime + context.outputLatency);
  document.documentElement.dataset.contactHeard = String(leaves);
  document.documentElement.dataset.outputLatency = String(1000 * context.outputLatency);
}

/** Several loud sounds at once are bent, not cut: 1.5 x - 0.5 x^3. */
function softLimit(): Float32Array<ArrayBuffer> {
  return Float32Array.from({ length: 2049 }, (_, i) => {
    const x = i / 1024 - 1;
    return 1.5 * x - 0.5 * x ** 3;
  });
}
