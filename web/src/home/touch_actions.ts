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
import { fineStep, type KeyTarget, type Move } from './keys';
import type { HeadsetPanel } from './headset_panel';
import type { Narrator } from './narrator';
import type { ReplayPanel } from '../replay/replay_panel';
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
  headset: HeadsetPanel;
  replay: ReplayPanel;
  /** False: this page pauses instead. */
  stopRobot(): boolean;
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

  /** In a replay, left and right go through it. */
  move(by: Move): void {
    if (this.parts.replay.isOpen) return by.x === 0 ? this.parts.replay.sayMoment() : this.parts.replay.step(Math.round(by.x / fineStep));
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
    if (this.parts.replay.isOpen) return this.parts.replay.step(-Infinity);
    this.parts.motion.recentre();
  }
  toSurface(): void {
    if (this.parts.replay.isOpen) return this.parts.replay.step(Infinity);
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
    if (this.parts.headset.leave()) return;
    if (this.parts.replay.isOpen) return this.parts.replay.close();
    if (!this.parts.names.stopFinding()) this.parts.guided.leave();
  }
  walk(by: Walk): void {
    this.live(() => this.parts.walking.walk(by));
    this.parts.request();
  }
  pose(): void {
    this.parts.walking.sayPose();
  }
  choose(probe: number): void {
    this.live(() => this.parts.probeActions.choose(probe));
  }
  take(): void {
    this.live(() => this.parts.probeActions.take());
  }
  describeProbes(): void {
    this.parts.probeActions.describeProbes();
  }
  pause(): void {
    if (this.parts.replay.isOpen) return this.parts.replay.toggle();
    if (this.parts.stopRobot()) return;
    this.parts.send({ type: 'pause', paused: !this.parts.paused() });
  }
  mute(): void {
    this.parts.settings.toggleSound();
  }
  help(): void {
    showHelp();
  }
  guide(): void {
    this.parts.replay.close();
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

  /** What acts on the touch itself: not while a recording is replayed, which says where it is instead. */
  private live(act: () => void): void {
    if (this.parts.replay.isOpen) this.parts.replay.sayMoment();
    else act();
  }

  /** Binds the page's buttons. */
  bind(): void {
    const { parts } = this;
    const actions: Record<string, () => void> = {
      pause: () => this.pause(),
      recentre: () => this.live(() => parts.motion.recentre()),
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
      ...parts.replay.actions,
      ...exampleActions(parts.feedback, () => parts.probes.own.chosen, (words) => parts.say(words, Importance.answer)),
    };
    bindButtons(actions, () => parts.wake());
    element('name-here').addEventListener('click', (event) => parts.names.nameByButton(event));
  }
}
