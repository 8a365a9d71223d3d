// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Whether an audio output loses sound, since the machine is too slow for its latency.

/** Of AudioContext.playbackStats, seconds since the context began. */
export interface PlaybackStats {
  readonly underrunDuration: number;
  readonly totalDuration: number;
}

/** Time over which it is judged (s), and how many such times in a row must be bad: audio that begins is late at first. */
const judgedTime = 2;
const badTimes = 2;
const bearablePart = 0.01;

export class OutputPace {
  private since: PlaybackStats | null = null;
  private bad = 0;

  /** True if more than a hundredth was lost of the last two seconds, and of the two before them. */
  losesSound({ underrunDuration, totalDuration }: PlaybackStats): boolean {
    const { since } = this;
    if (since !== null && totalDuration - since.totalDuration < judgedTime) return false;
    this.since = { underrunDuration, totalDuration };
    const isBad = since !== null && underrunDuration - since.underrunDuration > bearablePart * (totalDuration - since.totalDuration);
    this.bad = isBad ? this.bad + 1 : 0;
    return this.bad >= badTimes;
  }
}

/** The figures of a context; null where the browser does not count them. */
export function playbackStatsOf(context: AudioContext): PlaybackStats | null {
  return (context as AudioContext & { readonly playbackStats?: PlaybackStats }).playbackStats ?? null;
}
