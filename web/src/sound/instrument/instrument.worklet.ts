// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The instrument in the browser's audio thread. Commands come through the port; the times of contacts' onsets go back.
import { Instrument, type Command } from './instrument';

/** Of the audio worklet's global scope, which the standard declarations of TypeScript leave out. */
declare const sampleRate: number;
declare const currentTime: number;
declare abstract class AudioWorkletProcessor {
  readonly port: MessagePort;
}
declare function registerProcessor(name: string, processor: new (options: AudioWorkletNodeOptions) => AudioWorkletProcessor): void;

registerProcessor(
  'palpable-instrument',
  class extends AudioWorkletProcessor {
    private readonly instrument = new Instrument(sampleRate);
    private ended = false;

    constructor({ processorOptions }: AudioWorkletNodeOptions) {
      super();
      for (const command of processorOptions as Command[]) this.instrument.send(command);
      this.port.onmessage = ({ data }: MessageEvent<Command | null>) => {
        if (data === null) this.ended = true;
        else this.instrument.send(data);
      };
    }

    process(_inputs: Float32Array[][], [output]: Float32Array[][]): boolean {
      const [channel] = output!;
      if (channel !== undefined) this.instrument.render(channel, currentTime);
      const onset = this.instrument.takeOnset();
      if (onset !== null) this.port.postMessage(onset);
      return !this.ended;
    }
  },
);
