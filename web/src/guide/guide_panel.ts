// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The strip over the picture that offers the guided start and shows its steps, and the outlines of what they mean.
import { t } from '../language';
import { element } from '../dom';
import type { GuideView } from './guide';
import type { Way } from './steps';

const outlined = 'meant';
const label: Record<Way, string> = { eyes: t('For the eyes'), ears: t('For the ears') };

export class GuidePanel {
  private readonly strip = element('guide');

  /** `steps`: at which one each way goes on; 0: from the beginning. */
  offer(steps: Record<Way, number>): void {
    for (const way of ['eyes', 'ears'] as const) element(`guide-${way}`).textContent = steps[way] > 0 ? t('{way}, go on', { way: label[way] }) : label[way];
    this.write(t('Learn to touch, two minutes'), t('A guided start on this scene.'), 'offer');
  }

  /** A step, or none. */
  show(view: GuideView | null): void {
    this.outline(view?.meant ?? []);
    if (view === null) this.strip.hidden = true;
    else this.write(`${view.way === 'ears' ? t('Guided start for the ears.') : t('Guided start for the eyes.')} ${view.title}`, view.text, 'step');
  }

  private write(title: string, text: string, what: 'offer' | 'step'): void {
    element('guide-title').textContent = title;
    element('guide-text').textContent = text;
    element('guide-offer').hidden = what !== 'offer';
    element('guide-step').hidden = what !== 'step';
    this.strip.toggleAttribute('data-offer', what === 'offer');
    this.strip.hidden = false;
  }

  private outline(ids: readonly string[]): void {
    for (const one of document.querySelectorAll(`.${outlined}`)) one.classList.remove(outlined);
    for (const id of ids) element(id).classList.add(outlined);
  }
}
