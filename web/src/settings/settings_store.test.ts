// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Change, Edit, Law, Materials, Settings as ProgramSettings } from '../generated/protocol';
import { defaults } from './preferences';
import { withLaw, type Settings } from './settings';
import { SettingsStore } from './settings_store';

const parameter = (name: string, set: number | null, used: number) => ({ name, set, used });
const answered = (answers: number, stiffness: number | null, used = stiffness ?? 500): ProgramSettings => ({
  type: 'settings', answers, law: 'proxy', parameters: [parameter('stiffness_N_per_m', stiffness, used), parameter('static_friction', null, 0.3)],
  height_factor: 1, paused: false,
});
const holds = answered(0, null);
const material = (stiffness_N_per_m: number, kind: string) => ({
  stiffness_N_per_m, damping_Ns_per_m: 0.5, friction: 0.3, stickiness: 0.2, texture: { kind, pitch_m: 0.002, height_m: 3e-5, angle_deg: 0 },
});
const made: Materials = {
  type: 'materials', answers: 0,
  materials: [{ name: null, material: material(500, 'none') }, { name: 'ground', material: material(400, 'grain') }],
};
const initial: Settings = { touch: { law: '', set: {}, heightFactor: 1 }, page: defaults, materials: [] };

function kept() {
  const sent: (Change | Edit)[] = [];
  let time = 0;
  const store = new SettingsStore(initial, (change) => sent.push(change), () => time, 10);
  const pass = (ms: number) => (time += ms);
  const touch = (to: Partial<Settings['touch']>, what = 'slider') =>
    store.change({ ...store.settings, touch: { ...store.settings.touch, ...to } }, what);
  const stiffness = (value: number) => touch({ set: { stiffness_N_per_m: value } });
  const edit = (label: number, to: object, what = 'material') =>
    store.change({ ...store.settings, materials: store.settings.materials.map((m, k) => (k === label ? { ...m, ...to } : m)) }, what);
  return { store, sent, pass, touch, stiffness, edit };
}

describe('the settings', () => {
  it('request nothing before the first report', () => {
    const { store, sent } = kept();
    store.change({ ...initial, page: { ...defaults, volume: 10 } }, 'volume');
    expect(sent).toEqual([]);
    store.receive(holds);
    expect(store.settings.touch.law).toBe('proxy');
    expect(store.settings.page.volume).toBe(10);
    expect(store.canUndo).toBe(false);
  });
  it('send a change once, and undo restores the unset value', () => {
    const { store, sent, stiffness } = kept();
    store.receive(holds);
    stiffness(800);
    expect(sent).toEqual([{ type: 'change', serial: 11, law: 'proxy', parameters: [{ name: 'stiffness_N_per_m', value: 800 }], height_factor: 1 }]);
    store.receive(answered(11, 800));
    expect(sent).toHaveLength(1);
    expect(store.undoOrRedo('undo')).toBe('stiffness');
    expect(sent[1]).toMatchObject({ serial: 12, parameters: [] });
    expect(store.undoOrRedo('undo')).toBeNull();
    expect(store.undoOrRedo('redo')).toBe('stiffness');
    expect(sent[2]).toMatchObject({ serial: 13, parameters: [{ value: 800 }] });
  });
  it('know the effective values of set and unset parameters', () => {
    const { store, stiffness } = kept();
    store.receive(holds);
    expect(store.used).toEqual({ stiffness_N_per_m: 500, static_friction: 0.3 });
    stiffness(500);
    expect(store.settings.touch.set).toEqual({ stiffness_N_per_m: 500 });
  });
  it('keep the slider\'s value while older answers arrive', () => {
    const { store, stiffness } = kept();
    store.receive(holds);
    stiffness(600);
    stiffness(700);
    expect(store.receive(answered(11, 600))).toBe(false);
    expect(store.used.stiffness_N_per_m).toBe(700);
    expect(store.receive(answered(12, 412))).toBe(true);
    expect(store.used.stiffness_N_per_m).toBe(412);
  });
  it('take the program\'s values after a timeout and after a new connection', () => {
    const { store, pass, stiffness } = kept();
    store.receive(holds);
    stiffness(600);
    pass(5000);
    expect(store.receive(answered(3, null))).toBe(true);
    stiffness(600);
    store.connected();
    expect(store.receive(answered(3, null))).toBe(true);
    expect(store.settings.touch.set).toEqual({});
  });
  it('undo page settings without the program', () => {
    const { store, sent } = kept();
    store.receive(holds);
    store.change({ ...store.settings, page: { ...defaults, theme: 'dark' } }, 'theme');
    expect(store.undoOrRedo('undo')).toBe('colours');
    expect(store.settings.page.theme).toBe('system');
    expect(sent).toEqual([]);
  });
  it('are reset to the start, which can be undone', () => {
    const { store, touch } = kept();
    store.receive(holds);
    touch({ set: { stiffness_N_per_m: 600 }, heightFactor: 2 });
    store.reset();
    expect(store.settings.touch).toMatchObject({ set: {}, heightFactor: 1 });
    store.undoOrRedo('undo');
    expect(store.settings.touch).toMatchObject({ set: { stiffness_N_per_m: 600 }, heightFactor: 2 });
  });
  it('send an edited material alone, and undo it by name', () => {
    const { store, sent, edit } = kept();
    store.receive(holds);
    expect(store.receiveMaterials(made)).toBe(true);
    edit(1, { stiffness_N_per_m: 150 });
    expect(sent).toEqual([
      { type: 'edit', serial: 11, label: 1, material: { stiffness_N_per_m: 150, damping_Ns_per_m: null, friction: null, stickiness: null, texture: null } },
    ]);
    expect(store.receiveMaterials({ ...made, answers: 3 })).toBe(false);
    const softer = { name: 'ground', material: material(150, 'grain') };
    expect(store.receiveMaterials({ ...made, answers: 11, materials: [made.materials[0]!, softer] })).toBe(true);
    expect(store.undoOrRedo('undo')).toBe('stiffness of ground');
    expect(sent[1]).toMatchObject({ type: 'edit', serial: 12, label: 1, material: { stiffness_N_per_m: 400 } });
    expect(store.undoOrRedo('redo')).toBe('stiffness of ground');
    store.reset();
    expect(store.settings.materials[1]).toMatchObject({ stiffness_N_per_m: 400 });
  });
  it('take the materials of a new scene', () => {
    const { store, sent, edit } = kept();
    store.receive(holds);
    store.receiveMaterials(made);
    edit(1, { friction: 0.9 });
    expect(store.receiveMaterials({ ...made, materials: [made.materials[0]!], answers: 0 })).toBe(true);
    expect(store.settings.materials).toHaveLength(1);
    expect(store.settings.materials[0]?.name).toBe('the surface');
    store.undoOrRedo('undo');
    expect(sent.filter(({ type }) => type === 'edit')).toHaveLength(1);
  });
});

describe('another law', () => {
  const law = (name: string, ...units: [string, string][]): Law => ({
    name, title: name, has_materials: true, has_texture: true, unavailable: null, parameters: units.map(([parameterName, unit]) => ({ name: parameterName, title: '', unit, min: 0, max: 1 })),
  });
  const [wall, ball] = [law('wall', ['stiffness', 'N/m'], ['damping', 'N·s/m']), law('ball', ['stiffness', 'N'], ['damping', 'N·s/m'])];
  it('keeps parameters with the same meaning only', () => {
    const touch = { law: 'wall', set: { stiffness: 500, damping: 2 }, heightFactor: 1 };
    expect(withLaw(touch, wall, ball)).toEqual({ law: 'ball', set: { damping: 2 }, heightFactor: 1 });
  });
});
