// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What is said of the scene and of the probes: the program makes the words (docs/adr/0006), the page asks for them.
import type { Ask, Words as Answer } from '../generated/protocol';
import type { Probes } from '../probe/probes';
import { noScene, type Words } from '../sound/announcer';
import type { Place } from '../surface';
import type { SceneFrames } from './scene_frames';

type Question = 'opening' | 'scene' | 'position' | 'step' | 'press' | 'probe';

export class Narrator {
  private serial = 0;
  private readonly open = new Map<number, (text: string | null) => void>();
  /** The part of the description that D says next; another question begins it anew. */
  private part = 0;

  constructor(
    private readonly frames: SceneFrames,
    private readonly probes: Probes,
    private readonly send: (message: Ask) => void,
  ) {}

  /** The program's words for a question. */
  receive({ serial, text }: Answer): void {
    this.open.get(serial)?.(text);
    this.open.delete(serial);
  }
  /** The connection is gone: nothing that was asked is answered any more. */
  forget(): void {
    for (const answer of this.open.values()) answer(null);
    this.open.clear();
  }

  /** Said when the scene is there: its name and the maker's description. */
  opening(): Words {
    return () => this.ask('opening');
  }
  /** What D says: the scene in short; when asked again, more. */
  describe(): Words {
    const part = this.part;
    this.part += 1;
    return () => this.ask('scene', this.probes.own.chosen, part);
  }
  /** What P says. */
  where(): Words {
    this.part = 0;
    return () => this.named(this.ask('position'));
  }
  /** What a step led to. */
  step(free: boolean): Words {
    this.part = 0;
    return () => this.named(this.ask('step').then((words) => words && (free ? words : `Rim of the scene. ${words}`)));
  }
  press(): Words {
    this.part = 0;
    return () => this.named(this.ask('press'));
  }
  /** What lies under a probe that was put down or chosen. */
  chosen(what: string): Words {
    return () => this.ask('step').then((words) => words && `${what}. ${words}`);
  }
  /** How many probes there are, where, and what each feels. */
  all(): Words {
    return async () => {
      const { states, own } = this.probes;
      if (this.frames.surface === null || states.length === 0) return noScene;
      const each = await Promise.all(states.map(async ({ probe }) => `Probe ${probe + 1}: ${await this.ask('probe', probe)}`));
      const count = each.length === 1 ? 'One probe.' : `${each.length} probes, the keys move probe ${own.chosen + 1}.`;
      return `${count} ${each.join(' ')}`;
    };
  }

  place(): Place {
    return this.probes.placeOf(this.probes.own.chosen);
  }

  private async named(words: Promise<string | null>): Promise<string | null> {
    const text = await words;
    return text && this.probes.named(text);
  }

  private ask(what: Question, probe = this.probes.own.chosen, part = 0): Promise<string | null> {
    if (this.frames.surface === null) return Promise.resolve(noScene);
    this.serial += 1;
    const { serial } = this;
    const { x, y } = this.probes.placeOf(probe);
    const answer = new Promise<string | null>((resolve) => this.open.set(serial, resolve));
    this.send({ type: 'ask', serial, what, probe, x_m: x, y_m: y, press_m: this.probes.own.at(probe)?.press ?? 0, part });
    return answer;
  }
}
