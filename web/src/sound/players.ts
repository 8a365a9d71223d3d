// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Instruments in an audio context: in its audio worklet, or, where a browser refuses that, on the page's own thread.
import { Instrument, type Command } from './instrument/instrument';
import worklet from './instrument/instrument.worklet.ts?worker&url';

export interface Player {
  readonly node: AudioNode;
  send(command: Command): void;
  end(): void;
}

/** Makes a player with these first commands. */
export type MakePlayer = (commands: readonly Command[]) => Player;

/** Samples that the page's own thread computes at a time: 21 ms at 48 kHz. */
const pageBlock = 1024;

/** `heard`: called with the context's time (s) of the first sample of each contact. */
export async function loadPlayers(context: BaseAudioContext, heard: (onset: number) => void): Promise<MakePlayer> {
  // Pages of a plain web host, without TLS, have no worklets.
  if ((context.audioWorklet as AudioWorklet | undefined) !== undefined) {
    try {
      await context.audioWorklet.addModule(worklet);
      return (commands) => workletPlayer(context, commands, heard);
    } catch {
      // Refused: by a policy, or by a browser that does not load it from there.
    }
  }
  return (commands) => pagePlayer(context, commands, heard);
}

function workletPlayer(context: BaseAudioContext, commands: readonly Command[], heard: (onset: number) => void): Player {
  const node = new AudioWorkletNode(context, 'palpable-instrument', { numberOfInputs: 0, outputChannelCount: [1], processorOptions: commands });
  node.port.onmessage = ({ data }: MessageEvent<number>) => heard(data);
  return { node, send: (command) => node.port.postMessage(command), end: () => node.port.postMessage(null) };
}

function pagePlayer(context: BaseAudioContext, commands: readonly Command[], heard: (onset: number) => void): Player {
  const instrument = new Instrument(context.sampleRate);
  for (const command of commands) instrument.send(command);
  const node = context.createScriptProcessor(pageBlock, 0, 1);
  node.onaudioprocess = ({ outputBuffer, playbackTime }) => {
    instrument.render(outputBuffer.getChannelData(0), playbackTime);
    const onset = instrument.takeOnset();
    if (onset !== null) heard(onset);
  };
  return { node, send: (command) => instrument.send(command), end: () => (node.onaudioprocess = null) };
}
