// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The steps of the guided start, and their sentences: for the eyes or the ears, for keys, fingers or a device, and for the
// kind of the scene.
import { t } from '../language';

/** In this order. A step that the scene or the device does not allow is left out. */
export const stepNames = ['surface', 'edge', 'follow', 'height', 'where', 'list', 'find', 'undo', 'leave'] as const;
export type StepName = (typeof stepNames)[number];

export type Way = 'eyes' | 'ears';

/** What the steps depend on. */
export interface Situation {
  way: Way;
  /** What moves the probe; keys: and the mouse. */
  input: 'keys' | 'fingers' | 'device';
  /** The scene's, as in protocol.json. */
  kind: string;
  sound: boolean;
  /** Whether the surface has anything steep. */
  hasEdges: boolean;
  /** Whether anything has a name; null: not known. */
  hasNames: boolean | null;
}

/** The steps that can be done. */
export function stepsOf({ kind, hasEdges, hasNames }: Pick<Situation, 'kind' | 'hasEdges' | 'hasNames'>): StepName[] {
  // Beside the lines of a drawing all places are equally high.
  const hasHeights = kind !== 'contours';
  const can: Partial<Record<StepName, boolean>> = { surface: hasHeights, edge: hasEdges, follow: hasEdges, height: hasHeights, find: hasNames !== false };
  return stepNames.filter((step) => can[step] ?? true);
}

/** What is outlined on the page for the eyes: ids. */
export const meant: Record<StepName, readonly string[]> = {
  surface: ['stage'],
  edge: ['stage'],
  follow: ['stage'],
  height: ['read-height'],
  where: ['where', 'spoken'],
  list: ['places'],
  find: ['places'],
  undo: ['theme', 'undo'],
  leave: ['guide-leave', 'guide-begin'],
};

type Sentence = (situation: Situation, way: string | null) => string;

const isDrawing = ({ kind }: Situation) => kind === 'contours';
/** How a probe is moved, as a sentence. */
const move = ({ input, way }: Situation) =>
  ({
    keys: way === 'eyes' ? t('Move the marble with the mouse or the arrow keys.') : t('Move with the arrow keys, with Shift in larger steps.'),
    fingers: t('Drag a finger over the picture.'),
    device: t('Move the handle of your device.'),
  })[input];
const press = ({ input }: Situation, key: string, button: string) =>
  input === 'fingers' ? t('Press the button “{button}”:', { button }) : t('Press {key}, or the button “{button}”:', { key, button });
const join = (...sentences: string[]) => sentences.filter((sentence) => sentence !== '').join(' ');

/** Where that is; nothing if it is not known. */
const nearest = (way: string | null) => (way === null ? '' : way === '' ? t('The nearest one is where you are.') : t('The nearest one is {way}.', { way }));
const highest = (way: string | null) => (way === null ? '' : way === '' ? t('The highest place is where you are.') : t('The highest place is {way}.', { way }));

function edgeWords(situation: Situation): string {
  if (isDrawing(situation)) return situation.sound ? t('Find a line: a short bright tone marks it.') : t('Find a line: a push to the side marks it.');
  return situation.sound
    ? t('Find an edge, where it gets steep: a short bright tone marks it.')
    : t('Find an edge, where it gets steep: a push to the side marks it.');
}

function followWords(situation: Situation): string {
  const hears = situation.way === 'ears' && situation.input !== 'device';
  if (isDrawing(situation))
    return hears
      ? t('Follow the line for 10 millimetres: try a little to each side, and stay where you hear it.')
      : t('Follow the line for 10 millimetres: try a little to each side, and stay where you feel it.');
  return hears
    ? t('Follow the edge for 10 millimetres: try a little to each side, and stay where you hear it.')
    : t('Follow the edge for 10 millimetres: try a little to each side, and stay where you feel it.');
}

/** The sentences; `way`: to where the step leads, as "12 millimetres right"; empty: one is there; null: not known. */
const sentences: Record<StepName, Sentence> = {
  surface: ({ input, way, kind }) => {
    if (input === 'device') return t('Lower the handle of your device until something holds against it: that is the surface.');
    if (input === 'fingers') return t('Put a finger on the picture and drag it. A marble follows it over the surface, slower uphill and faster downhill.');
    if (way === 'eyes') return t('Move the mouse over the picture: the marble follows it over the surface, slower uphill and faster downhill. Its arrow is the force.');
    const isSolid = kind.endsWith('field') || kind.endsWith('grid');
    return join(
      isSolid ? t('Press End: it takes you to the surface.') : '',
      t('Press Page Down a few times: you press deeper into the surface, and its force grows. A knock is a contact.'),
    );
  },
  edge: (situation, way) =>
    join(edgeWords(situation), move(situation), nearest(way), isDrawing(situation) && situation.input === 'keys' ? t('End takes you to the nearest one.') : ''),
  follow: (situation) => join(followWords(situation), t('It need not be in one go.')),
  height: (situation, way) =>
    situation.sound
      ? join(t('Heights are tones: the higher the place, the higher the tone.'), move(situation), t('Go up and down until you have heard low and high.'), highest(way))
      : join(t('Heights are figures below the picture.'), move(situation), t('Go up and down, and watch “Height”.'), highest(way)),
  where: (situation) => join(press(situation, 'P', t('Where am I?')), t('where you are and what is there is said, and stands below the picture.')),
  list: (situation) =>
    join(
      press(situation, 'L', t('What is here?')),
      t('a list of names opens, the nearest first. Look through it.'),
      situation.input === 'fingers' ? t('“Close” closes it.') : t('Escape closes it.'),
    ),
  find: (situation) =>
    join(
      situation.input === 'fingers' ? t('Open the list once more, choose a name, and press “Lead me there”.') : t('Open the list once more, choose a name, and press Enter.'),
      situation.sound ? t('You are led by words and by pulses, which come from its side and are quicker the nearer it is. Go there.') : t('You are led by words. Go there.'),
    ),
  undo: ({ input, way }) =>
    input === 'fingers' || way === 'eyes'
      ? t('Every change of a setting can be undone. Choose other “Colours” in the settings, then press “Undo”.')
      : t('Every change of a setting can be undone. Press M, which turns the sound off, or on. Then press Control and Z: that is undone.'),
  leave: ({ input }) =>
    input === 'fingers'
      ? t('That was the guided start. Press “Leave”, and explore on your own.')
      : t('That was the guided start. Press Escape, or the button “Leave”, and explore on your own. D describes the scene, H tells all keys.'),
};

export const sentenceOf = (step: StepName, situation: Situation, way: string | null = null): string => sentences[step](situation, way);
