// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The keys and their actions: one table for the page and its help.

import { t } from '../language';
import { pace, turnBy } from '../probe/explorer';

export interface Move {
  /** Metres. */
  x: number;
  y: number;
  /** Deeper (positive) or higher, metres. */
  press: number;
}

export interface KeyTarget {
  move(by: Move): void;
  describe(): void;
  where(): void;
  recentre(): void;
  /** Metres ahead, and degrees to the left. */
  walk(by: { ahead: number; left: number }): void;
  pose(): void;
  /** Counted from 0. */
  choose(probe: number): void;
  take(): void;
  describeProbes(): void;
  pause(): void;
  mute(): void;
  /** Goes to the nearest surface. */
  toSurface(): void;
  /** The list of names. */
  listPlaces(): void;
  nameHere(): void;
  sayWay(): void;
  /** Leaves the headset, else is no longer led to a name, else leaves the guided start. */
  leave(): void;
  /** Zooms by a factor. */
  zoom(factor: number): void;
  resetView(): void;
  /** Switches drags, pinches and arrows between moving the picture and the probe. */
  moveView(): void;
  /** Switches them between moving the head and the probe. */
  moveHead(): void;
  help(): void;
  /** Begins the guided start, or says its step again. */
  guide(): void;
  skipStep(): void;
}

export const fineStep = 0.001;
export const coarseStep = 0.005;
export const pressStep = 0.0005;

const arrows: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

interface KeyRow {
  shown: string;
  does: string;
  keys: string[];
  act(target: KeyTarget, event: Pick<KeyboardEvent, 'key' | 'shiftKey'>): void;
}

export const keyRows: KeyRow[] = [
  {
    shown: t('Arrow keys'),
    does: t('Move the probe by 1 millimetre; with Shift by 5'),
    keys: Object.keys(arrows),
    act: (target, { key, shiftKey }) => {
      const [x, y] = arrows[key] ?? [0, 0];
      const step = shiftKey ? coarseStep : fineStep;
      target.move({ x: x * step, y: y * step, press: 0 });
    },
  },
  {
    shown: t('Page Down, Page Up'),
    does: t('Press half a millimetre deeper; lift'),
    keys: ['PageDown', 'PageUp'],
    act: (target, { key }) => target.move({ x: 0, y: 0, press: key === 'PageDown' ? pressStep : -pressStep }),
  },
  { shown: 'D', does: t('Describe the scene; again for more'), keys: ['d'], act: (target) => target.describe() },
  { shown: 'P', does: t('Say position and height'), keys: ['p'], act: (target) => target.where() },
  { shown: t('Home'), does: t('Back to the middle'), keys: ['Home'], act: (target) => target.recentre() },
  { shown: t('End'), does: t('To the nearest surface, line or street'), keys: ['End'], act: (target) => target.toSurface() },
  { shown: 'L', does: t('What is here: list the names, the nearest first; Enter leads to one'), keys: ['l'], act: (target) => target.listPlaces() },
  { shown: 'T', does: t('Type a name for this place'), keys: ['t'], act: (target) => target.nameHere() },
  { shown: 'G', does: t('Say the way to the name again'), keys: ['g'], act: (target) => target.sayWay() },
  { shown: t('Escape'), does: t('Leave the headset; no longer be led to a name; leave the guided start'), keys: ['Escape'], act: (target) => target.leave() },
  {
    shown: 'W, S',
    does: t('In the egocentric view: walk 5 millimetres ahead, back; with Shift 20'),
    keys: ['w', 's'],
    act: (target, { key, shiftKey }) => target.walk({ ahead: (key.toLowerCase() === 'w' ? 1 : -1) * (shiftKey ? 4 : 1) * pace, left: 0 }),
  },
  {
    shown: 'A, F',
    does: t('In the egocentric view: turn left, right by 15 degrees; with Shift by 45'),
    keys: ['a', 'f'],
    act: (target, { key, shiftKey }) => target.walk({ ahead: 0, left: (key.toLowerCase() === 'a' ? 1 : -1) * (shiftKey ? 3 : 1) * turnBy }),
  },
  { shown: 'E', does: t('In the egocentric view: say where you stand'), keys: ['e'], act: (target) => target.pose() },
  {
    shown: t('1 to 9, 0'),
    does: t('Select the probe of that number (0 is the tenth); a new one is added at the place of the current one'),
    keys: [...'1234567890'],
    act: (target, { key }) => target.choose((Number(key) + 9) % 10),
  },
  { shown: t('Delete'), does: t('Remove this probe; the first one cannot be removed'), keys: ['Delete', 'Backspace'], act: (target) => target.take() },
  { shown: 'N', does: t('Say where every probe is and what it feels'), keys: ['n'], act: (target) => target.describeProbes() },
  { shown: t('Space'), does: t('Pause, resume'), keys: [' '], act: (target) => target.pause() },
  { shown: '+, −', does: t('Zoom the picture in, out'), keys: ['+', '=', '-'], act: (target, { key }) => target.zoom(key === '-' ? 0.8 : 1.25) },
  {
    shown: 'C',
    does: t('Move the picture: arrows turn it, with Shift they shift it; C again moves the probe'),
    keys: ['c'],
    act: (target) => target.moveView(),
  },
  {
    shown: 'V',
    does: t('In a depth mode, move your head: arrows move it, with Shift up and down nearer and farther; V again moves the probe'),
    keys: ['v'],
    act: (target) => target.moveHead(),
  },
  { shown: 'R', does: t('Reset the picture'), keys: ['r'], act: (target) => target.resetView() },
  { shown: 'M', does: t('Sound off, on'), keys: ['m'], act: (target) => target.mute() },
  { shown: 'I', does: t('Guided start: begin, or say the step again'), keys: ['i'], act: (target) => target.guide() },
  { shown: 'K', does: t('In the guided start, skip a step'), keys: ['k'], act: (target) => target.skipStep() },
  { shown: t('H or ?'), does: t('This help'), keys: ['h', '?'], act: (target) => target.help() },
];

/** Runs the key's action; false if it has none. */
export function press(event: Pick<KeyboardEvent, 'key' | 'shiftKey' | 'ctrlKey' | 'altKey' | 'metaKey'>, target: KeyTarget): boolean {
  if (event.ctrlKey || event.altKey || event.metaKey) return false;
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const row = keyRows.find(({ keys }) => keys.includes(key));
  row?.act(target, event);
  return row !== undefined;
}

/** The action of a key with Control or Command. */
export function undoKey(event: Pick<KeyboardEvent, 'key' | 'shiftKey' | 'ctrlKey' | 'altKey' | 'metaKey'>): 'undo' | 'redo' | null {
  if (!(event.ctrlKey || event.metaKey) || event.altKey) return null;
  const key = event.key.toLowerCase();
  if (key === 'z') return event.shiftKey ? 'redo' : 'undo';
  return key === 'y' ? 'redo' : null;
}
