// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A recording on the page: opening it, the strip with its controls, and saving it as a clip.
import { fixed, t } from '../language';
import { element } from '../dom';
import { download } from '../download';
import type { State } from '../generated/protocol';
import type { Surface } from '../surface';
import { Clip, clipType } from './clip';
import { fits, otherWords, Player, spokenTime, speeds } from './player';
import { readRecording } from './recording';

export interface ReplayPage {
  surface(): Surface | null;
  heightFactor(): number;
  sceneName(): string;
  /** A moment of the recording, as a state of the program; `jumped`: it does not follow the last one. */
  show(state: State, jumped: boolean): void;
  /** A recording is open from now on, or no longer. */
  changed(): void;
  /** The answer to a user action; and what else is to be known. */
  say(words: string): void;
  tell(words: string): void;
  /** The name of a label that the first probe enters. */
  enter(label: number): void;
  /** Whether the touch itself is paused. */
  paused(): boolean;
  /** Requests a frame. */
  request(): void;
  canvas(): HTMLCanvasElement | null;
  /** What is heard, while a clip is recorded; null: nothing. */
  tap(): Promise<MediaStream | null>;
  untap(): void;
}

/** Longest time that a frame may have to catch up with (s): a page that was hidden does not. */
const mostBehind = 0.1;
/** Milliseconds between two changes of the figures. */
const figuresEvery = 200;
/** Milliseconds between two sentences on how much of a file is read. */
const readSaidEvery = 4000;
/** Shares of a clip at which its progress is said. */
const saidShares = [0.25, 0.5, 0.75];

export class ReplayPanel {
  private readonly strip = element('replay');
  private readonly slider = element<HTMLInputElement>('replay-at');
  private readonly speed = element<HTMLSelectElement>('replay-speed');
  private player: Player | null = null;
  private drawnAt: number | null = null;
  private figuresAt = -Infinity;
  private label: number | null = null;
  private clip: { clip: Clip; from: number; said: number } | null = null;
  private opening = 0;

  constructor(private readonly page: ReplayPage) {
    const file = element<HTMLInputElement>('replay-file');
    file.addEventListener('change', () => {
      const [chosen] = file.files ?? [];
      file.value = '';
      if (chosen) void this.open(chosen);
    });
    this.speed.replaceChildren(...speeds.map((speed) => new Option(t('{value} ×', { value: speed }), String(speed), speed === 1, speed === 1)));
    this.speed.addEventListener('change', () => this.player && (this.player.speed = Number(this.speed.value)));
    this.slider.addEventListener('input', () => this.seek(this.slider.valueAsNumber));
    document.addEventListener('visibilitychange', () => this.clip?.clip.pause(document.hidden));
  }

  /** The actions of its buttons, by id. */
  get actions(): Record<string, () => void> {
    return {
      'replay-open': () => element<HTMLInputElement>('replay-file').click(),
      'replay-play': () => this.toggle(),
      'replay-clip': () => (this.clip === null ? void this.beginClip() : void this.endClip(false)),
      'replay-end': () => this.close(),
    };
  }

  get isOpen(): boolean {
    return this.player !== null;
  }

  async open(file: File): Promise<void> {
    const opening = ++this.opening;
    this.page.say(t('Reading {name}.', { name: file.name }));
    let saidAt = performance.now();
    const progress = (share: number) => {
      if (performance.now() - saidAt < readSaidEvery || opening !== this.opening) return;
      saidAt = performance.now();
      this.page.tell(t('{share} percent read.', { share: Math.floor(100 * share) }));
    };
    const recording = await readRecording(file.name, file, progress).catch(() => t('{name} cannot be read.', { name: file.name }));
    if (opening !== this.opening) return;
    const surface = this.page.surface();
    if (typeof recording === 'string' || surface === null) return this.page.say(typeof recording === 'string' ? recording : t('There is no scene yet.'));
    this.close();
    this.player = new Player(recording);
    this.speed.value = '1';
    this.slider.max = String(Number(this.player.length.toFixed(2)));
    this.slider.step = this.player.length > 60 ? '1' : '0.1';
    element('replay-title').textContent = t('Replay of {name}', { name: recording.name });
    const note = `${recording.fault ?? ''} ${fits(recording, surface) ? '' : otherWords(recording.inputs, this.page.sceneName())}`.trim();
    element('replay-note').textContent = note;
    this.strip.hidden = false;
    this.page.changed();
    this.show(true);
    element('replay-play').focus();
    this.page.say([t('Replay of {name}, {time}.', { name: recording.name, time: spokenTime(this.player.length) }), note, t('Space plays, left and right go back and on by a second.')].filter((part) => part !== '').join(' '));
  }

  /** Ends the replay: the page shows the touch again. */
  close(): void {
    if (this.player === null) return;
    if (this.clip) void this.endClip(false);
    this.player = null;
    this.label = null;
    const had = this.strip.contains(document.activeElement);
    this.strip.hidden = true;
    this.page.changed();
    this.page.say(t('The replay has ended: the page shows the touch again.') + (this.page.paused() ? ` ${t('It is paused: Space resumes it.')}` : ''));
    if (had) element('stage').focus({ preventScroll: true });
  }

  toggle(): void {
    const { player } = this;
    if (player === null || this.clip) return;
    if (player.isPlaying) player.pause();
    else player.play();
    this.drawnAt = null;
    this.figures(true);
    this.page.say(player.isPlaying ? t('Plays.') : t('Stopped at {words}.', { words: player.words() }));
    this.page.request();
  }

  /** Goes on by so many seconds, back if they are negative, and says where that is. */
  step(seconds: number): void {
    if (this.player === null) return;
    this.seek(this.player.time + seconds);
    this.sayMoment();
  }
  sayMoment(): void {
    if (this.player) this.page.say(`${this.player.words()}.`);
  }

  /** Call it for each frame; true while it plays. */
  frame(now: number): boolean {
    const { player } = this;
    if (player === null || !player.isPlaying) return false;
    const passed = this.drawnAt === null ? 0 : Math.min(mostBehind, (now - this.drawnAt) / 1000);
    this.drawnAt = now;
    const goesOn = player.advance(passed);
    this.show(false);
    if (this.clip) this.showClip(player, this.clip);
    if (goesOn) return true;
    this.figures(true);
    if (this.clip) void this.endClip(true);
    else this.page.tell(t('The end of the recording.'));
    return false;
  }

  /** Shows this moment anew, as after a change of the height factor. */
  renew(): void {
    this.show(false);
  }

  private seek(time: number): void {
    const { player } = this;
    if (player === null || this.clip) return;
    player.seek(time);
    this.show(true);
    this.figures(true);
  }

  private show(jumped: boolean): void {
    const [{ player }, surface] = [this, this.page.surface()];
    if (player === null || surface === null) return;
    const state = player.state(surface, this.page.heightFactor());
    this.page.show(state, jumped);
    const label = state.probes[0]?.label ?? null;
    if (label !== null && label !== this.label && this.label !== null && !jumped) this.page.enter(label);
    this.label = label;
    this.figures(jumped);
  }

  private figures(now: boolean): void {
    const { player } = this;
    const at = performance.now();
    if (player === null || (!now && at - this.figuresAt < figuresEvery)) return;
    this.figuresAt = at;
    this.slider.value = String(player.time);
    const words = player.words();
    this.slider.setAttribute('aria-valuetext', words);
    element('replay-at-value').textContent = words;
    element('replay-play').textContent = player.isPlaying ? t('Stop') : t('Play');
  }

  // The clip.

  private async beginClip(): Promise<void> {
    const { player } = this;
    const [type, canvas] = [clipType(), this.page.canvas()];
    if (player === null) return;
    if (type === null || canvas === null) return this.page.say(t('This browser cannot record clips.'));
    player.pause();
    const sound = await this.page.tap();
    if (player !== this.player) return this.page.untap();
    try {
      this.clip = { clip: new Clip(canvas, sound, type), from: player.time >= player.length ? 0 : player.time, said: 0 };
    } catch {
      this.page.untap();
      return this.page.say(t('This browser refuses to record a clip.'));
    }
    player.play();
    this.drawnAt = null;
    this.enable(false);
    this.page.say(t('The clip is being recorded while the recording plays, from here to its end. Keep this page visible.'));
    this.page.request();
  }

  private showClip(player: Player, clip: { from: number; said: number }): void {
    const share = (player.time - clip.from) / Math.max(1e-9, player.length - clip.from);
    element('replay-words').textContent = t('Recording the clip: {share} %', { share: Math.floor(100 * share) });
    const next = saidShares[clip.said];
    if (next === undefined || share < next) return;
    clip.said += 1;
    this.page.tell(t('{next} percent of the clip.', { next: 100 * next }));
  }

  /** Saves it, or drops it. */
  private async endClip(complete: boolean): Promise<void> {
    const { player, clip: running } = this;
    if (running === null) return;
    this.clip = null;
    player?.pause();
    this.enable(true);
    this.figures(true);
    element('replay-words').textContent = '';
    const film = await running.clip.finish();
    this.page.untap();
    if (!complete || player === null) return this.page.say(t('The clip was cancelled: nothing is saved.'));
    const name = `${player.recording.name.replace(/\.[^.]*$/, '')}.webm`;
    download(name, film);
    element('replay-words').textContent = t('The clip is saved as {name}.', { name });
    this.page.say(t('The clip is saved as {name}, {size} megabytes.', { name, size: fixed(film.size / 1e6, 1) }));
  }

  private enable(free: boolean): void {
    element('replay-clip').textContent = free ? t('Save as a clip') : t('Cancel the clip');
    for (const control of [this.slider, this.speed, element<HTMLButtonElement>('replay-play')]) control.disabled = !free;
  }
}
