// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The guided start on this page: what it learns of the touch, and how it is offered, begun and left.
import { t } from '../language';
import { element } from '../dom';
import { Guide, type GuideView } from '../guide/guide';
import { GuidePanel } from '../guide/guide_panel';
import type { Progress } from '../guide/memory';
import type { Situation, Way } from '../guide/steps';
import type { ProbeState } from '../generated/protocol';
import { newtons } from '../probe/probes';
import { Importance, type Words } from '../sound/announcer';
import type { Place, Surface } from '../surface';

/** How far a person is, beyond this visit. */
export interface KeptProgress {
  read(): Progress;
  keep(progress: Progress): void;
}

export interface GuidedPage {
  situation(): Omit<Situation, 'way' | 'hasEdges' | 'hasNames' | 'input'>;
  /** Whether a device moves the probe. */
  byDevice(): boolean;
  surface(): Surface | null;
  heightFactor(): number;
  place(): Place;
  say(words: Words | string, importance: Importance): void;
  /** A line on the surface; empty: none. */
  mark(points: readonly Place[]): void;
}

/** Metres on a scene of 0.1 m: the radius of the ring around what is meant. */
const ringRadius = 0.004;
const ringCorners = 36;
/** Newtons that are felt. */
const leastFelt = 0.02;
const withoutKeys = matchMedia('(hover: none) and (pointer: coarse)');

export class GuidedStart {
  private readonly panel = new GuidePanel();
  private readonly guide: Guide;

  constructor(
    private readonly page: GuidedPage,
    kept: KeptProgress,
  ) {
    this.guide = new Guide(
      {
        situation: () => ({ ...page.situation(), input: page.byDevice() ? 'device' : withoutKeys.matches ? 'fingers' : 'keys' }),
        surface: () => page.surface(),
        heightFactor: () => page.heightFactor(),
        place: () => page.place(),
        say: (words, said) =>
          page.say(() => {
            said();
            return words;
          }, Importance.answer),
        show: (view) => this.show(view),
        keep: (progress) => kept.keep(progress),
      },
      kept.read(),
    );
    // A list that was looked through has been closed.
    element('places-dialog').addEventListener('close', () => this.guide.listed(element<HTMLSelectElement>('places-list').length));
  }

  /** The actions of its buttons, by id. */
  get actions(): Record<string, () => void> {
    return {
      'guide-begin': () => this.choose(),
      'guide-eyes': () => this.begin('eyes'),
      'guide-ears': () => this.begin('ears'),
      'guide-later': () => this.decline(),
      'guide-again': () => this.guide.again(),
      'guide-skip': () => this.guide.skip(),
      'guide-leave': () => this.leave(),
    };
  }

  /** On the first visit: shows the offer, and gives the sentence that says so; else empty. */
  offer(): string {
    if (!this.guide.isToBeOffered) return '';
    this.choose();
    return withoutKeys.matches ? ` ${t('A guided start of two minutes is offered above the picture.')}` : ` ${t('I begins a guided start of two minutes.')}`;
  }

  /** The key: begins it for the ears, or goes on with the way that was left; while it runs, says its step again. */
  key(): void {
    if (this.guide.isRunning) return this.guide.again();
    this.begin(this.guide.stepOf('ears') === 0 && this.guide.stepOf('eyes') > 0 ? 'eyes' : 'ears');
  }
  skip(): void {
    if (this.guide.isRunning) this.guide.skip();
  }
  /** False: it does not run. */
  leave(): boolean {
    if (!this.guide.isRunning) return false;
    const isDone = this.guide.leave();
    this.page.say(isDone ? t('The guided start is done. I begins it anew.') : t('The guided start is left. I goes on with it.'), Importance.answer);
    this.toStage();
    return true;
  }

  /** Without a word: for something else that is wanted now. */
  withdraw(): void {
    if (this.guide.isRunning) this.guide.leave();
    else this.panel.show(null);
  }

  // What happens in the touch.

  pressed(): void {
    this.guide.did('pressed');
  }
  askedWhere(): void {
    this.guide.did('asked where');
  }
  found(): void {
    this.guide.did('found');
  }
  undid(): void {
    this.guide.did('undid');
  }
  /** A state of the selected probe, which is at `place`. */
  felt(probe: ProbeState | undefined, place: Place): void {
    if (!this.guide.isRunning || probe === undefined) return;
    // Some laws have forces without a contact.
    if (probe.contact || newtons(probe) > leastFelt) this.guide.did('touched');
    this.guide.moved(place);
  }

  private begin(way: Way): void {
    this.guide.offered();
    this.guide.begin(way);
    this.toStage();
  }

  private choose(): void {
    this.panel.offer({ eyes: this.guide.stepOf('eyes'), ears: this.guide.stepOf('ears') });
    if (document.activeElement?.id === 'guide-begin') element('guide-eyes').focus();
  }

  private decline(): void {
    this.guide.offered();
    this.panel.show(null);
    this.page.say(t('The guided start is under “Guided start”, below the picture.'), Importance.answer);
    this.toStage();
  }

  private show(view: GuideView | null): void {
    this.panel.show(view);
    const surface = this.page.surface();
    const at = view?.at ?? null;
    this.page.mark(at === null || surface === null ? [] : ring(at, ringRadius * surface.scale));
  }

  /** The keys act there. */
  private toStage(): void {
    element('stage').focus({ preventScroll: true });
  }
}

function ring({ x, y }: Place, radius: number): Place[] {
  return Array.from({ length: ringCorners + 1 }, (_, k) => {
    const angle = (2 * Math.PI * k) / ringCorners;
    return { x: x + radius * Math.cos(angle), y: y + radius * Math.sin(angle) };
  });
}
