// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What a person can do, by key and by button.
import { element } from '../dom';
import type { FromPage } from '../generated/protocol';
import type { Names } from '../names/names';
import { pace, turnBy } from '../probe/explorer';
import type { ProbeActions } from '../probe/probe_actions';
import type { Probes } from '../probe/probes';
import type { Walk, Walking } from '../probe/walking';
import { Importance, type Words } from '../sound/announcer';
import { exampleActions } from '../sound/examples';
import type { Feedback } from '../sound/feedback';
import { bindButtons } from './bindings';
import type { GuidedStart } from './guided_start';
import { showHelp } from './help';
import type { KeyTarget, Move } from './keys';
import type { Narrator } from './narrator';
import type { ProbeMotion } from './probe_motion';
import type { TouchSettings } from './touch_settings';
import type { ViewActions } from './view_actions';

/** What the actions act on. */
export interface ActionParts {
  motion: ProbeMotion;
  narrator: Narrator;
  names: Names;
  walking: Walking;
  probes: Probes;
  probeActions: ProbeActions;
  settings: TouchSettings;
  picture: ViewActions;
  feedback: Feedback;
  guided: GuidedStart;
  paused(): boolean;
  say(words: Words | string, importance: Importance): void;
  send(message: FromPage): void;
  /** Requests a frame. */
  request(): void;
  /** Starts audio, which browsers allow after a user action only. */
  wake(): void;
  turnOnSound(): void;
}

export class TouchActions implements KeyTarget {
  constructor(private readonly parts: ActionParts) {}

  move(by: Move): void {
    this.parts.motion.move(by);
    if (by.press > 0) this.parts.guided.pressed();
  }
  describe(): void {
    this.parts.say(this.parts.narrator.describe(), Importance.answer);
  }
  where(): void {
    this.parts.say(this.parts.narrator.where(), Importance.answer);
    this.parts.guided.askedWhere();
  }
  recentre(): void {
    this.parts.motion.recentre();
  }
  toSurface(): void {
    this.parts.motion.toSurface();
  }
  listPlaces(): void {
    this.parts.names.open();
  }
  nameHere(): void {
    this.parts.names.nameHere();
  }
  sayWay(): void {
    this.parts.names.sayWay();
  }
  leave(): void {
    if (!this.parts.names.stopFinding()) this.parts.guided.leave();
  }
  walk(by: Walk): void {
    this.parts.walking.walk(by);
    this.parts.request();
  }
  pose(): void {
    this.parts.walking.sayPose();
  }
  choose(probe: number): void {
    this.parts.probeActions.choose(probe);
  }
  take(): void {
    this.parts.probeActions.take();
  }
  describeProbes(): void {
    this.parts.probeActions.describeProbes();
  }
  pause(): void {
    this.parts.send({ type: 'pause', paused: !this.parts.paused() });
  }
  mute(): void {
    this.parts.settings.toggleSound();
  }
  help(): void {
    showHelp();
  }
  guide(): void {
    this.parts.guided.key();
  }
  skipStep(): void {
    this.parts.guided.skip();
  }
  zoom(factor: number): void {
    this.parts.picture.zoom(factor);
  }
  resetView(): void {
    this.parts.picture.reset();
  }
  moveView(): void {
    this.parts.picture.toggleMoving();
  }
  moveHead(): void {
    this.parts.picture.toggleHead();
  }
  /** Of names and settings the one that was changed last. */
  undoOrRedo(which: 'undo' | 'redo'): void {
    const { names, settings, guided } = this.parts;
    const changed = names.undoOrRedo(which) || settings.undoOrRedo(which);
    if (changed && which === 'undo') guided.undid();
  }

  /** Binds the page's buttons. */
  bind(): void {
    const { parts } = this;
    const actions: Record<string, () => void> = {
      pause: () => this.pause(),
      recentre: () => this.recentre(),
      describe: () => this.describe(),
      where: () => this.where(),
      'sound-on': () => parts.turnOnSound(),
      'move-view': () => this.moveView(),
      'move-head': () => this.moveHead(),
      'zoom-in': () => this.zoom(1.25),
      'zoom-out': () => this.zoom(0.8),
      'reset-view': () => this.resetView(),
      'walk-ahead': () => this.walk({ ahead: pace, left: 0 }),
      'walk-back': () => this.walk({ ahead: -pace, left: 0 }),
      'turn-left': () => this.walk({ ahead: 0, left: turnBy }),
      'turn-right': () => this.walk({ ahead: 0, left: -turnBy }),
      pose: () => this.pose(),
      help: () => this.help(),
      places: () => this.listPlaces(),
      undo: () => this.undoOrRedo('undo'),
      redo: () => this.undoOrRedo('redo'),
      reset: () => parts.settings.reset(),
      'region-here': () => parts.settings.editRegion(parts.probes.chosen?.label ?? 0),
      save: () => parts.send({ type: 'save' }),
      ...parts.guided.actions,
      ...exampleActions(parts.feedback, () => parts.probes.own.chosen, (words) => parts.say(words, Importance.answer)),
    };
    bindButtons(actions, () => parts.wake());
    element('name-here').addEventListener('click', (event) => parts.names.nameByButton(event));
  }
}
