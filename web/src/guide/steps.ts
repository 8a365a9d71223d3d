// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The steps of the guided start, and their sentences: for the eyes or the ears, for keys, fingers or a device, and for the
// kind of the scene.

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

const line = (kind: string) => (kind === 'contours' ? 'line' : 'edge');
/** How a probe is moved, as the beginning of a sentence. */
const move = ({ input, way }: Situation) =>
  ({
    keys: way === 'eyes' ? 'Move the marble with the mouse or the arrow keys' : 'Move with the arrow keys, with Shift in larger steps',
    fingers: 'Drag a finger over the picture',
    device: 'Move the handle of your device',
  })[input];
const press = ({ input }: Situation, key: string, button: string) => (input === 'fingers' ? `Press the button “${button}”` : `Press ${key}, or the button “${button}”`);

/** The end of a sentence: where that is; nothing if it is not known. */
const whereIs = (what: string, way: string | null) => (way === null ? '' : ` The ${what} is ${way === '' ? 'where you are' : way}.`);

/** The sentences; `way`: to where the step leads, as "12 millimetres right"; empty: one is there; null: not known. */
const sentences: Record<StepName, Sentence> = {
  surface: ({ input, way, kind }) => {
    if (input === 'device') return 'Lower the handle of your device until something holds against it: that is the surface.';
    if (input === 'fingers') return 'Put a finger on the picture and drag it. A marble follows it over the surface, slower uphill and faster downhill.';
    if (way === 'eyes') return 'Move the mouse over the picture: the marble follows it over the surface, slower uphill and faster downhill. Its arrow is the force.';
    const first = kind.endsWith('field') || kind.endsWith('grid') ? 'Press End: it takes you to the surface. Then press' : 'Press';
    return `${first} Page Down a few times: you press deeper into the surface, and its force grows. A knock is a contact.`;
  },
  edge: (situation, way) => {
    const what = line(situation.kind);
    const tone = situation.sound ? 'a short bright tone' : 'a push to the side';
    const end = situation.kind === 'contours' && situation.input === 'keys' ? ' End takes you to the nearest one.' : '';
    return `Find ${what === 'edge' ? 'an edge, where it gets steep' : 'a line'}: ${tone} marks it. ${move(situation)}.${whereIs('nearest one', way)}${end}`;
  },
  follow: ({ kind, input, way }) =>
    `Follow the ${line(kind)} for 10 millimetres: try a little to each side, and stay where you ${way === 'ears' && input !== 'device' ? 'hear' : 'feel'} it. It need not be in one go.`,
  height: (situation, way) =>
    situation.sound
      ? `Heights are tones: the higher the place, the higher the tone. ${move(situation)}, up and down, until you have heard low and high.${whereIs('highest place', way)}`
      : `Heights are figures below the picture. ${move(situation)}, up and down, and watch “Height”.${whereIs('highest place', way)}`,
  where: (situation) => `${press(situation, 'P', 'Where am I?')}: where you are and what is there is said, and stands below the picture.`,
  list: (situation) => `${press(situation, 'L', 'What is here?')}: a list of names opens, the nearest first. Look through it; ${situation.input === 'fingers' ? 'Close' : 'Escape'} closes it.`,
  find: (situation) => {
    const by = situation.sound ? 'words and by pulses, which come from its side and are quicker the nearer it is' : 'words';
    return `Open the list once more, choose a name, and ${situation.input === 'fingers' ? 'press “Lead me there”' : 'press Enter'}. You are led by ${by}. Go there.`;
  },
  undo: ({ input, way }) =>
    input === 'fingers' || way === 'eyes'
      ? 'Every change of a setting can be undone. Choose other “Colours” in the settings, then press “Undo”.'
      : 'Every change of a setting can be undone. Press M, which turns the sound off, or on. Then press Control and Z: that is undone.',
  leave: ({ input }) =>
    `That was the guided start. ${input === 'fingers' ? 'Press “Leave”' : 'Press Escape, or the button “Leave”'}, and explore on your own.${input === 'fingers' ? '' : ' D describes the scene, H tells all keys.'}`,
};

export const sentenceOf = (step: StepName, situation: Situation, way: string | null = null): string => sentences[step](situation, way);

/** "12 millimetres right, 5 millimetres up"; empty within a millimetre. Metres, from here to there. */
export function wayWords(dx: number, dy: number): string {
  const part = (metres: number, positive: string, negative: string) => {
    const millimetres = Math.round(Math.abs(metres) * 1000);
    return millimetres === 0 ? [] : [`${millimetres} ${millimetres === 1 ? 'millimetre' : 'millimetres'} ${metres > 0 ? positive : negative}`];
  };
  return [...part(dx, 'right', 'left'), ...part(dy, 'up', 'down')].join(', ');
}
