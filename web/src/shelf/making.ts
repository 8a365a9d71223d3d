// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// How far a scene is, until its touch begins.
import { known, t } from '../language';
import { element } from '../dom';
import type { Job } from '../generated/protocol';
import { setSent } from '../sent_language';
import { tell } from './program';

const period = 300;
/** Between two sentences, so that a screen reader can finish. */
const quietFor = 4000;
/** Until the same sentence is said again. */
const quietForSame = 30000;

export class Making {
  private saidAt = 0;
  private said = '';

  constructor(private readonly wait = (ms: number) => new Promise<void>((resolve) => setTimeout(resolve, ms))) {}

  /** Shows a job until it has ended, and returns its end. Throws a Refusal. */
  async follow(begin: () => Promise<{ job: number }>, say: (words: string) => void): Promise<Job> {
    let isCancelled = false;
    const cancel = element<HTMLButtonElement>('cancel');
    cancel.disabled = false;
    cancel.onclick = () => {
      isCancelled = true;
      cancel.disabled = true;
    };
    this.show({ fraction: null, step: t('Reading'), notes: [] });
    const { job } = await begin();
    for (;;) {
      const state = await tell(isCancelled ? { type: 'cancel', job } : { type: 'follow', job }, 'job');
      if (!['making', 'opening', 'saving'].includes(state.state)) return state;
      this.show(state);
      const now = Date.now();
      const words = element('step').textContent ?? '';
      if (now - this.saidAt > (words === this.said ? quietForSame : quietFor)) {
        say(words === this.said ? t('Still {words}', { words }) : words);
        this.saidAt = now;
        this.said = words;
      }
      await this.wait(period);
    }
  }

  private show({ fraction, step, notes }: Pick<Job, 'fraction' | 'step' | 'notes'>): void {
    const bar = element<HTMLProgressElement>('fraction');
    if (fraction === null) bar.removeAttribute('value');
    else bar.value = fraction;
    element('step').textContent = fraction === null ? `${known(step)} …` : t('{step}: {percent} %', { step: known(step), percent: Math.round(100 * fraction) });
    const list = element('notes');
    if (list.childElementCount === notes.length) return;
    list.replaceChildren(
      ...notes.map((note) => {
        const line = document.createElement('li');
        setSent(line, known(note));
        return line;
      }),
    );
  }
}
