// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Settings with undo, and their exchange with the program: requests are sent, effective values come back.
import { known, t } from '../language';
import type { Change, Edit, Law, Materials, Settings as ProgramSettings } from '../generated/protocol';
import { History } from './history';
import { editOf, materialsOf, type Material } from './materials';
import { defaults } from './preferences';
import { sameTouch, type Settings, type TouchSettings } from './settings';

/** Timeout for the answer to a change, after which the program's values are used (ms). */
const answerTime = 3000;
const titles: Record<string, string> = {
  sound: t('sound'),
  volume: t('volume'),
  speech: t('speech'),
  vibration: t('vibration'),
  gamepads: t('gamepads'),
  theme: t('colours'),
  view: t('view'),
  surface: t('surface'),
  tilt: t('tilt'),
  friction: t('friction'),
  stickiness: t('stickiness'),
  texture: t('texture'),
  headsetSize: t('size in the headset'),
  contactVolume: t('volume of contacts'),
  slideVolume: t('volume of sliding'),
  heightVolume: t('volume of heights'),
  edgeVolume: t('volume of edges'),
  nameVolume: t('volume of names'),
  findVolume: t('volume of finding'),
  heightFactor: t('height'),
  law: t('force law'),
  damping_Ns_per_m: t('damping'),
  stiffness_N_per_m: t('stiffness'),
  pitch_m: t('texture pitch'),
  height_m: t('texture height'),
  angle_deg: t('texture angle'),
  depthMode: t('depth mode'),
  eyeDistance: t('eye distance'),
  screenDistance: t('screen distance'),
  depthBefore: t('part before the screen'),
  depthShare: t('depth'),
  depthComfort: t('disparities within a degree'),
  secondView: t('second photograph'),
  swapEyes: t('exchanged eyes'),
  cameraAngle: t('camera’s angle of view'),
  cameraTilt: t('camera’s tilt'),
  cameraAbove: t('camera above the screen'),
  cameraRight: t('camera to the right'),
  headGainX: t('head to the sides'),
  headGainY: t('head up and down'),
  headGainZ: t('head nearer and farther'),
  pixelSize: t('size of the screen'),
};

export class SettingsStore {
  private readonly history: History<Settings>;
  /** The settings when the page was opened; null if unknown. */
  private begun: TouchSettings | null = null;
  /** The last requested or reported settings. */
  private asked: TouchSettings | null = null;
  private begunMaterials: Material[] | null = null;
  private askedMaterials: Material[] = [];
  private askedAt = -Infinity;
  private serial: number;
  private usedValues: Readonly<Record<string, number>> = {};
  private parameterTitles: Readonly<Record<string, string>> = {};

  constructor(
    initial: Settings,
    private readonly send: (message: Change | Edit) => void,
    private readonly now: () => number = () => performance.now(),
    firstSerial = Math.floor(Math.random() * 2 ** 31),
  ) {
    this.history = new History(initial);
    this.serial = firstSerial;
  }

  get settings(): Settings {
    return this.history.now;
  }
  /** The effective values of the law's parameters, by name. */
  get used(): Readonly<Record<string, number>> {
    return { ...this.usedValues, ...this.settings.touch.set };
  }
  get steps(): number {
    return this.history.steps;
  }
  get canUndo(): boolean {
    return this.history.canUndo;
  }
  get canRedo(): boolean {
    return this.history.canRedo;
  }
  /** Whether the user has changed anything here. */
  get wasUsed(): boolean {
    return this.canUndo || this.canRedo;
  }

  setLaws(laws: readonly Law[]): void {
    this.parameterTitles = Object.fromEntries(laws.flatMap(({ parameters }) => parameters.map(({ name, title }) => [name, known(title).toLowerCase()])));
  }

  change(settings: Settings, what: string): void {
    this.history.change(settings, what, this.now());
    this.ask();
  }

  reset(): void {
    const materials = this.begunMaterials ?? this.settings.materials;
    this.change({ touch: this.begun ?? this.settings.touch, page: { ...defaults }, materials }, 'reset');
  }

  /** The name of the changed setting, or null if there was nothing to undo or redo. */
  undoOrRedo(which: 'undo' | 'redo'): string | null {
    const before = this.settings;
    if (!this.history[which]()) return null;
    this.ask();
    return this.difference(before, this.settings);
  }

  /** A new connection: earlier requests may be lost. */
  connected(): void {
    this.asked = null;
    this.askedAt = -Infinity;
  }

  /** The effective values from the program. False if they answer an earlier change than the last, while a slider is dragged. */
  receive({ answers, law, parameters, height_factor: heightFactor }: ProgramSettings): boolean {
    if (this.waits(answers)) return false;
    const set = Object.fromEntries(parameters.flatMap((parameter) => (parameter.set === null ? [] : [[parameter.name, parameter.set]])));
    const touch = { law, set, heightFactor };
    this.usedValues = Object.fromEntries(parameters.map(({ name, used }) => [name, used]));
    this.asked = touch;
    const settings = { ...this.settings, touch };
    if (this.begun === null) {
      this.begun = touch;
      this.history.restart(settings);
    } else {
      this.history.correct(settings);
    }
    return true;
  }

  /** The same for the materials; a new scene resets them. */
  receiveMaterials(message: Materials): boolean {
    const materials = materialsOf(message);
    const another = materials.length !== this.begunMaterials?.length;
    if (!another && this.waits(message.answers)) return false;
    this.askedMaterials = materials;
    const settings = { ...this.settings, materials };
    if (another) {
      this.begunMaterials = materials;
      this.history.restart(settings);
    } else {
      this.history.correct(settings);
    }
    return true;
  }

  private waits(answers: number): boolean {
    return this.asked !== null && answers !== this.serial && this.now() - this.askedAt < answerTime;
  }

  private ask(): void {
    const { touch, materials } = this.settings;
    if (this.begun === null) return;
    if (!sameTouch(touch, this.asked ?? this.begun)) {
      this.asked = touch;
      const parameters = Object.entries(touch.set).map(([name, value]) => ({ name, value }));
      this.send({ type: 'change', serial: this.next(), law: touch.law, parameters, height_factor: touch.heightFactor });
    }
    materials.forEach((material, label) => {
      const asked = this.askedMaterials[label];
      const edit = asked && editOf(asked, material);
      if (edit) this.send({ type: 'edit', serial: this.next(), label, material: edit });
    });
    this.askedMaterials = this.askedMaterials.map((asked, label) => materials[label] ?? asked);
  }

  private next(): number {
    this.serial = (this.serial + 1) % 2 ** 32;
    this.askedAt = this.now();
    return this.serial;
  }

  private difference(a: Settings, b: Settings): string {
    const between = (before: object, after: object) =>
      [...new Set([...Object.keys(before), ...Object.keys(after)])]
        .filter((key) => (before as Record<string, unknown>)[key] !== (after as Record<string, unknown>)[key])
        .map((key) => titles[key] ?? this.parameterTitles[key] ?? key);
    const materials = b.materials.flatMap((material, label) => {
      const before = a.materials[label];
      return before === undefined ? [] : between(before, material).map((what) => t('{what} of {name}', { what, name: material.name }));
    });
    const { set: setBefore, ...before } = a.touch;
    const { set: setAfter, ...after } = b.touch;
    return [...between(before, after), ...between(setBefore, setAfter), ...between(a.page, b.page), ...materials].join(', ');
  }
}
