// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Spoken descriptions of the scene and the probes: the program makes the sentences (docs/adr/0006), and the page requests
// them.
import { t } from '../language';
import type { Ask, Words as Answer } from '../generated/protocol';
import type { Probes } from '../probe/probes';
import { noScene, type Words } from '../sound/announcer';
import type { Place } from '../surface';
import type { SceneFrames } from './scene_frames';

type Question = 'opening' | 'scene' | 'position' | 'step' | 'press' | 'probe' | 'way' | 'surface';

export class Narrator {
  private serial = 0;
  private readonly open = new Map<number, (answer: Answer | null) => void>();
  /** The next part of the description for D; another question resets it. */
  private part = 0;

  constructor(
    private readonly frames: SceneFrames,
    private readonly probes: Probes,
    private readonly send: (message: Ask) => void,
  ) {}

  /** The program's answer to a question. */
  receive(answer: Answer): void {
    this.open.get(answer.serial)?.(answer);
    this.open.delete(answer.serial);
  }
  /** The connection is lost: open questions get no answer. */
  forget(): void {
    for (const answer of this.open.values()) answer(null);
    this.open.clear();
  }

  /** Spoken when the scene has arrived: its name and the maker's description. */
  opening(): Promise<string | null> {
    return this.ask('opening');
  }
  /** The sentences for D: the scene in short, and more on each repetition. */
  describe(): Words {
    const part = this.part;
    this.part += 1;
    return () => this.ask('scene', this.probes.own.chosen, part);
  }
  /** The sentence for P. */
  where(): Words {
    this.part = 0;
    return () => this.named(this.ask('position'));
  }
  /** The place after a step. */
  step(free: boolean): Words {
    this.part = 0;
    return () => this.named(this.ask('step').then((words) => words && (free ? words : `${t('Rim of the scene.')} ${words}`)));
  }
  press(): Words {
    this.part = 0;
    return () => this.named(this.ask('press'));
  }
  /** The place of a probe that was added or selected. */
  chosen(what: string): Words {
    return () => this.ask('step').then((words) => words && `${what}. ${words}`);
  }
  /** The number of probes, their places and forces. */
  all(): Words {
    return async () => {
      const { states, own } = this.probes;
      if (this.frames.surface === null || states.length === 0) return noScene;
      const each = await Promise.all(states.map(async ({ probe }) => t('Probe {probe}: {words}', { probe: probe + 1, words: (await this.ask('probe', probe)) ?? '' })));
      const count = each.length === 1 ? t('One probe.') : t('{count, plural, one {# probe} other {# probes}}, the keys move probe {probe}.', { count: each.length, probe: own.chosen + 1 });
      return `${count} ${each.join(' ')}`;
    };
  }

  /** The way to the place that the selected probe is led to. */
  way(): Promise<Answer | null> {
    return this.request('way');
  }
  /** The nearest surface. */
  surface(): Promise<Answer | null> {
    return this.request('surface');
  }
  /** What is in the middle, for scenes that may be empty there. */
  middle(): Words {
    return () => this.ask('step').then((words) => words && this.probes.named(`${t('In the middle.')} ${words}`));
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
    return this.request(what, probe, part).then((answer) => answer && answer.text);
  }

  private request(what: Question, probe = this.probes.own.chosen, part = 0): Promise<Answer | null> {
    if (this.frames.surface === null) return Promise.resolve(null);
    this.serial += 1;
    const { serial } = this;
    const { x, y } = this.probes.placeOf(probe);
    const answer = new Promise<Answer | null>((resolve) => this.open.set(serial, resolve));
    this.send({ type: 'ask', serial, what, probe, x_m: x, y_m: y, press_m: this.probes.own.at(probe)?.press ?? 0, part });
    return answer;
  }
}
