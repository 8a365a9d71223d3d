// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Ask } from '../generated/protocol';
import { Probes } from '../probe/probes';
import { noScene, type Words } from '../sound/announcer';
import { Surface } from '../surface';
import { Narrator } from './narrator';
import { SceneFrames } from './scene_frames';

function frames(): SceneFrames {
  const loaded = new SceneFrames();
  loaded.surface = new Surface(2, 2, new Float32Array(4), 0.1, 0.1);
  return loaded;
}

/** A narrator with a program that answers each question with its name. */
function answered(loaded = frames()): { narrator: Narrator; asked: Ask[]; say: (words: Words) => Promise<string | null> } {
  const asked: Ask[] = [];
  const narrator = new Narrator(loaded, new Probes(), (ask) => {
    asked.push(ask);
    queueMicrotask(() => narrator.receive({ type: 'words', serial: ask.serial, text: `${ask.what}.`, x_m: null, y_m: null }));
  });
  return { narrator, asked, say: async (words) => words() };
}

describe('the narrator', () => {
  it('says more on each question for the scene, and restarts after another question', async () => {
    const { narrator, asked, say } = answered();
    await say(narrator.describe());
    await say(narrator.describe());
    await say(narrator.where());
    await say(narrator.describe());
    expect(asked.map(({ what, part }) => `${what} ${part}`)).toEqual(['scene 0', 'scene 1', 'position 0', 'scene 0']);
  });
  it('says the rim first', async () => {
    const { narrator, say } = answered();
    expect(await say(narrator.step(true))).toBe('step.');
    expect(await say(narrator.step(false))).toBe('Rim of the scene. step.');
  });
  it('asks nothing without a scene', async () => {
    const { narrator, asked, say } = answered(new SceneFrames());
    expect(await say(narrator.describe())).toBe(noScene);
    expect(asked).toEqual([]);
  });
  it('ends open questions when the connection is lost', async () => {
    const narrator = new Narrator(frames(), new Probes(), () => undefined);
    const words = narrator.where()();
    narrator.forget();
    expect(await words).toBe(null);
  });
});
