// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Plays a recording: where it is, how fast it goes, and the states of its probes.
import { fixed, listed, t } from '../language';
import type { ProbeState, State } from '../generated/protocol';
import type { Surface } from '../surface';
import type { Recording } from './recording';

export const speeds = [0.25, 0.5, 1, 2, 4] as const;

/** A probe without a row for this long is gone (s). */
const longestGap = 0.25;
/** Of a surface of 0.1 m: how far from it proxies in contact may lie on the median (m). */
const nearSurface = 0.0015;

export class Player {
  speed = 1;
  private playing = false;
  /** Seconds from the beginning. */
  private now = 0;

  constructor(readonly recording: Recording) {}

  get time(): number {
    return this.now;
  }
  get length(): number {
    return this.recording.end - this.recording.begin;
  }
  get isPlaying(): boolean {
    return this.playing;
  }

  /** Plays from here, or from the beginning if it is at the end. */
  play(): void {
    if (this.now >= this.length) this.now = 0;
    this.playing = true;
  }
  pause(): void {
    this.playing = false;
  }
  seek(time: number): void {
    this.now = Math.min(this.length, Math.max(0, time));
  }

  /** So many seconds have passed; false: it does not play, or has come to its end now. */
  advance(passed: number): boolean {
    if (!this.playing) return false;
    this.seek(this.now + passed * this.speed);
    if (this.now >= this.length) this.playing = false;
    return this.playing;
  }

  /** The state at this time, as the program would send it for this surface. */
  state(surface: Surface, heightFactor: number): State {
    const t = this.recording.begin + this.now;
    const probes: ProbeState[] = [];
    for (const [probe, track] of [...this.recording.tracks].sort(([a], [b]) => a - b)) {
      const row = track.at(t);
      if (row === null || (probe > 0 && t - row.time > Math.max(longestGap, 2 * track.spacing))) continue;
      const { x, y, z, fx, fy, fz, contact, label } = row.moment;
      const surface_m = surface.heightAt({ x, y }) * heightFactor;
      probes.push({ probe, page: null, x_m: x, y_m: y, z_m: z, surface_m, fx_N: fx, fy_N: fy, fz_N: fz, contact, label });
    }
    return { type: 'state', t_s: t, rate_hz: 0, probes, device: { x_m: 0, y_m: 0, z_m: 0, turned_deg: 0 } };
  }

  /** "12.3 seconds of 65 seconds, in contact, 1.20 newtons". */
  words(): string {
    const row = this.recording.tracks.get(0)?.at(this.recording.begin + this.now) ?? null;
    const times = { now: spokenTime(this.now), length: spokenTime(this.length) };
    if (row === null) return t('{now} of {length}', times);
    const { paused, contact, fx, fy, fz } = row.moment;
    if (paused) return t('{now} of {length}, paused', times);
    const values = { ...times, force: fixed(Math.hypot(fx, fy, fz), 2) };
    return contact ? t('{now} of {length}, in contact, {force} newtons', values) : t('{now} of {length}, in free air, {force} newtons', values);
  }
}

/** "12.3 seconds", "1 second", "2 minutes 5 seconds". */
export function spokenTime(seconds: number): string {
  if (seconds < 60) return t('{count, plural, one {# second} other {# seconds}}', { count: Number(seconds.toFixed(1)) });
  const whole = Math.round(seconds);
  const [minutes, rest] = [Math.floor(whole / 60), whole % 60];
  const long = t('{count, plural, one {# minute} other {# minutes}}', { count: minutes });
  return rest > 0 ? `${long} ${t('{count, plural, one {# second} other {# seconds}}', { count: rest })}` : long;
}

/** What is said of a recording that does not fit. A scene that was replaced by a better one is the same. */
export function otherWords(inputs: readonly string[], sceneName: string): string {
  const files = inputs.map((path) => path.split('/').pop()!);
  if (files.length > 0 && files.every((file) => sceneName.includes(file))) return t('It was made on another version of this scene, whose heights differ.');
  const other = t('It seems to be of another scene than this one.');
  return files.length > 0 ? `${other} ${t('It was made on {files}.', { files: listed(files) })}` : other;
}

/** Whether a recording may have been made on this surface: where it touched, there is one. True if it does not tell. */
export function fits({ contacts }: Pick<Recording, 'contacts'>, surface: Surface): boolean {
  if (contacts.length === 0) return true;
  const away = contacts.map(({ x, y, z, heightFactor }) => Math.abs(z - surface.heightAt({ x, y }) * heightFactor)).sort((a, b) => a - b);
  return away[Math.floor(away.length / 2)]! <= nearSurface * surface.scale;
}
