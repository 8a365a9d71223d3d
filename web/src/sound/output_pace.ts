// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Whether an audio output loses sound, since the machine is too slow for its latency.

/** Of AudioContext.playbackStats, seconds since the context began. */
export interface PlaybackStats {
  readonly underrunDuration: number;
  readonly totalDuration: number;
}

/** Time over which it is judged (s): the silence of one late block at the start is less than its bearable part. */
const judgedTime = 2;
const bearablePart = 0.01;

export class OutputPace {
  private since: PlaybackStats | null = null;

  /** True if more than a hundredth of the last two seconds was lost. */
  losesSound({ underrunDuration, totalDuration }: PlaybackStats): boolean {
    const { since } = this;
    if (since !== null && totalDuration - since.totalDuration < judgedTime) return false;
    this.since = { underrunDuration, totalDuration };
    return since !== null && underrunDuration - since.underrunDuration > bearablePart * (totalDuration - since.totalDuration);
  }
}

/** The figures of a context; null where the browser does not count them. */
export function playbackStatsOf(context: AudioContext): PlaybackStats | null {
  return (context as AudioContext & { readonly playbackStats?: PlaybackStats }).playbackStats ?? null;
}
