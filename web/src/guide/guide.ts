// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The guided start: says a step, waits until it is done on the scene, and goes on.
import { t } from '../language';
import type { Place, Surface } from '../surface';
import { Edges } from './edges';
import type { Progress } from './memory';
import { meant, sentenceOf, stepNames, stepsOf, type Situation, type StepName, type Way } from './steps';
import { wayWords } from '../way_words';

/** What a person has done, besides moving. */
export type Deed = 'pressed' | 'touched' | 'asked where' | 'listed' | 'found' | 'undid';

/** What is shown of the running step. */
export interface GuideView {
  way: Way;
  title: string;
  text: string;
  /** Ids of what is meant; empty for the ears. */
  meant: readonly string[];
  /** A place on the surface that is meant; null: none. */
  at: Place | null;
}

export interface GuidePage {
  situation(): Omit<Situation, 'way' | 'hasEdges' | 'hasNames'>;
  surface(): Surface | null;
  heightFactor(): number;
  place(): Place;
  /** Says it after what is being said; `said`: called when it is. */
  say(words: string, said: () => void): void;
  /** null: the guide is not running. */
  show(view: GuideView | null): void;
  keep(progress: Progress): void;
}

/** Time for the answer to what was done, before the next step is said (ms). */
const pause = 2000;
/** A sentence that was replaced by an answer is said again after this time (ms). */
const insistence = 3500;
/** Metres on a scene of 0.1 m: how near an edge counts, how far a movement and a way along an edge must be. */
const reach = 0.002;
const leastMove = 0.005;
const leastAlong = 0.01;
/** Longest part of a way along an edge between two places: beyond that it was jumped. */
const longestStep = 0.006;
/** The share of the scene's heights that must be heard. */
const heightShare = 0.25;

/** What was done since the step began. */
class Done {
  moved = 0;
  along = 0;
  lowest = Infinity;
  highest = -Infinity;
  readonly deeds = new Set<Deed>();
}

export class Guide {
  private way: Way | null = null;
  private step: StepName = 'surface';
  private done = new Done();
  /** Whether the person knows what to do: what was done before that does not count. */
  private known = false;
  private last: Place | null = null;
  private edges: Edges | null = null;
  private edgesOf: Surface | null = null;
  private hasNames: boolean | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly page: GuidePage,
    private progress: Progress,
  ) {}

  get isRunning(): boolean {
    return this.way !== null;
  }

  /** Begins, or goes on where it was left; at the beginning after its end. */
  begin(way: Way): void {
    const kept = this.progress[way];
    this.way = way;
    this.hasNames = null;
    const goesOn = kept > 0 && kept < stepNames.length;
    this.enter(this.possible(stepNames[goesOn ? kept : 0]!));
    this.say(goesOn ? `${t('You left it here.')} ` : '', 0);
  }
  /** The person has answered the offer of it, in whatever way. */
  offered(): void {
    if (!this.progress.offered) this.keep({ offered: true });
  }
  get isToBeOffered(): boolean {
    return !this.progress.offered;
  }
  /** At which step it goes on, counted from 1; 0: from the beginning. */
  stepOf(way: Way): number {
    const kept = this.progress[way];
    return kept < stepNames.length ? kept && kept + 1 : 0;
  }

  /** Whether that was its end. */
  leave(): boolean {
    if (this.way === null) return false;
    const isDone = this.step === 'leave';
    clearTimeout(this.timer);
    if (isDone) this.keep({ [this.way]: stepNames.length });
    this.way = null;
    this.page.show(null);
    return isDone;
  }
  again(): void {
    this.say('', 0);
  }
  skip(): void {
    this.next('', 0);
  }

  did(deed: Deed): void {
    if (this.way === null || !this.known) return;
    this.done.deeds.add(deed);
    this.goOn();
  }
  /** What the list shows. */
  listed(names: number): void {
    this.hasNames = names > 0;
    this.did('listed');
  }
  /** The probe is here now. */
  moved(place: Place): void {
    const surface = this.page.surface();
    if (this.way === null || !this.known || surface === null) return;
    const { done, last } = this;
    const step = last === null ? 0 : Math.hypot(place.x - last.x, place.y - last.y);
    if (last !== null && step === 0) return;
    this.last = place;
    done.moved += step;
    const height = surface.heightAt(place) * this.page.heightFactor();
    done.lowest = Math.min(done.lowest, height);
    done.highest = Math.max(done.highest, height);
    if (this.step === 'follow' && step <= longestStep * surface.scale && this.isAtEdge(place, surface)) done.along += step;
    this.goOn();
  }

  private isAtEdge(place: Place, surface: Surface): boolean {
    const edge = this.edges?.nearest(place) ?? null;
    return edge !== null && Math.hypot(edge.x - place.x, edge.y - place.y) < reach * surface.scale;
  }

  private isDone(): boolean {
    const surface = this.page.surface();
    if (surface === null) return false;
    const { done } = this;
    const hasMoved = done.moved > leastMove * surface.scale;
    switch (this.step) {
      case 'surface':
        return done.deeds.has('touched') && (done.deeds.has('pressed') || hasMoved);
      case 'edge':
        return done.moved > 0 && this.isAtEdge(this.page.place(), surface);
      case 'follow':
        return done.along > leastAlong * surface.scale;
      case 'height': {
        const { lowest, highest } = surface.range();
        return hasMoved && done.highest - done.lowest >= heightShare * (highest - lowest) * Math.abs(this.page.heightFactor());
      }
      case 'where':
        return done.deeds.has('asked where');
      case 'list':
        return done.deeds.has('listed');
      case 'find':
        return done.deeds.has('found');
      case 'undo':
        return done.deeds.has('undid');
      case 'leave':
        return false;
    }
  }

  private goOn(): void {
    if (this.isDone()) this.next(`${t('Good.')} `, pause);
  }

  private next(before: string, after: number): void {
    if (this.way === null) return;
    const following = stepNames[stepNames.indexOf(this.step) + 1];
    if (following === undefined) return void this.leave();
    const step = this.possible(following);
    const nothing = following === 'find' && step !== 'find' ? `${t('Nothing has a name here yet.')} ` : '';
    this.enter(step);
    this.say(before + nothing, after);
  }

  /** This step, or the first one after it that this scene allows. */
  private possible(step: StepName): StepName {
    const steps = stepsOf(this.situation());
    return stepNames.slice(stepNames.indexOf(step)).find((one) => steps.includes(one)) ?? 'leave';
  }

  private enter(step: StepName): void {
    this.step = step;
    this.done = new Done();
    this.last = null;
    // The eyes read it at once.
    this.known = this.way === 'eyes';
    if (this.way !== null) this.keep({ offered: true, [this.way]: stepNames.indexOf(step) });
  }

  private keep(progress: Partial<Progress>): void {
    this.progress = { ...this.progress, ...progress };
    this.page.keep(this.progress);
  }

  private situation(): Situation {
    const surface = this.page.surface();
    if (surface !== this.edgesOf) {
      this.edgesOf = surface;
      this.edges = surface && new Edges(surface, this.page.heightFactor());
    }
    return { ...this.page.situation(), way: this.way ?? 'ears', hasEdges: this.edges?.areThere ?? false, hasNames: this.hasNames };
  }

  /** Where the step leads from here. */
  private target(): Place | null {
    const at = this.page.place();
    if (this.step === 'edge') return this.edges?.nearest(at) ?? null;
    return this.step === 'height' ? (this.edges?.top ?? null) : null;
  }

  /** Shows the step at once, and says it after a time; again until it is heard. */
  private say(before: string, after: number): void {
    const { way } = this;
    if (way === null) return;
    const situation = this.situation();
    const steps = stepsOf(situation);
    const at = this.target();
    const from = this.page.place();
    const text = sentenceOf(this.step, situation, at === null ? null : wayWords(at.x - from.x, at.y - from.y));
    const title = t('Step {step} of {steps}', { step: steps.indexOf(this.step) + 1, steps: steps.length });
    this.page.show({ way, title, text, meant: way === 'eyes' ? meant[this.step] : [], at: way === 'eyes' ? at : null });
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.insist(`${before}${title}: ${text}`), after);
  }

  private insist(words: string): void {
    this.timer = setTimeout(() => this.insist(words), insistence);
    const { timer } = this;
    this.page.say(words, () => {
      // A sentence may be said after the step has changed.
      if (timer !== this.timer) return;
      clearTimeout(timer);
      this.known = true;
    });
  }
}
