// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Settings } from './controls';
import type { Change, Edit, Materials, Settings as ProgramSettings } from '../generated/protocol';
import { defaults } from './preferences';
import { SettingsStore } from './settings_store';

const holds: ProgramSettings = { type: 'settings', answers: 0, law: 'proxy', stiffness: 500, damping_Ns_per_m: 0.5, friction: 0.3, exaggeration: 1, neighbourhood_px: 3, paused: false };
const made: Materials = {
  type: 'materials', answers: 0, names: ['default', 'ground'], stiffness_N_per_m: [500, 400], damping_Ns_per_m: [0.5, 0.5], friction: [0.3, 0.3],
  stickiness: [0.2, 0.2], textures: ['none', 'grain'], pitch_m: [0.002, 0.002], height_m: [3e-5, 3e-5], angle_deg: [0, 0],
};
const initial: Settings = { touch: { law: '', stiffness: 0, damping_Ns_per_m: 0, friction: 0, exaggeration: 1, neighbourhood_px: 3 }, page: defaults, materials: [] };

function kept() {
  const sent: (Change | Edit)[] = [];
  let time = 0;
  const store = new SettingsStore(initial, (change) => sent.push(change), () => time, 10);
  const pass = (ms: number) => (time += ms);
  const touch = (wishes: Partial<Settings['touch']>, what = 'slider') =>
    store.change({ ...store.settings, touch: { ...store.settings.touch, ...wishes } }, what);
  const edit = (label: number, wish: object, what = 'material') =>
    store.change({ ...store.settings, materials: store.settings.materials.map((m, k) => (k === label ? { ...m, ...wish } : m)) }, what);
  return { store, sent, pass, touch, edit };
}

describe('the settings', () => {
  it('ask for nothing before it is known what holds', () => {
    const { store, sent } = kept();
    store.change({ ...initial, page: { ...defaults, volume: 10 } }, 'volume');
    expect(sent).toEqual([]);
    store.receive(holds);
    expect(store.settings.touch.law).toBe('proxy');
    expect(store.settings.page.volume).toBe(10);
    expect(store.canUndo).toBe(false);
  });
  it('send a change once, and undo sends what held before', () => {
    const { store, sent, touch } = kept();
    store.receive(holds);
    touch({ stiffness: 800 });
    expect(sent).toMatchObject([{ serial: 11, stiffness: 800 }]);
    store.receive({ ...holds, answers: 11, stiffness: 800 });
    expect(sent).toHaveLength(1);
    expect(store.undoOrRedo('undo')).toBe('stiffness');
    expect(sent[1]).toMatchObject({ serial: 12, stiffness: 500 });
    expect(store.undoOrRedo('undo')).toBeNull();
    expect(store.undoOrRedo('redo')).toBe('stiffness');
    expect(sent[2]).toMatchObject({ serial: 13, stiffness: 800 });
  });
  it('stay where the slider is while answers to its earlier places come in', () => {
    const { store, touch } = kept();
    store.receive(holds);
    touch({ stiffness: 600 });
    touch({ stiffness: 700 });
    expect(store.receive({ ...holds, answers: 11, stiffness: 600 })).toBe(false);
    expect(store.settings.touch.stiffness).toBe(700);
    expect(store.receive({ ...holds, answers: 12, stiffness: 412 })).toBe(true);
    expect(store.settings.touch.stiffness).toBe(412);
  });
  it('take what the program reports when no answer comes for long, and after a new connection', () => {
    const { store, pass, touch } = kept();
    store.receive(holds);
    touch({ stiffness: 600 });
    pass(5000);
    expect(store.receive({ ...holds, answers: 3 })).toBe(true);
    touch({ stiffness: 600 });
    store.connected();
    expect(store.receive({ ...holds, answers: 3 })).toBe(true);
    expect(store.settings.touch.stiffness).toBe(500);
  });
  it('undo what belongs to the page without asking the program', () => {
    const { store, sent } = kept();
    store.receive(holds);
    store.change({ ...store.settings, page: { ...defaults, theme: 'dark' } }, 'theme');
    expect(store.undoOrRedo('undo')).toBe('theme');
    expect(store.settings.page.theme).toBe('system');
    expect(sent).toEqual([]);
  });
  it('are as at the start after a reset, which can be undone', () => {
    const { store, touch } = kept();
    store.receive(holds);
    touch({ stiffness: 600, exaggeration: 2 });
    store.reset();
    expect(store.settings.touch).toMatchObject({ stiffness: 500, exaggeration: 1 });
    store.undoOrRedo('undo');
    expect(store.settings.touch).toMatchObject({ stiffness: 600, exaggeration: 2 });
  });
  it('send an edited material alone, and undo it by name', () => {
    const { store, sent, edit } = kept();
    store.receive(holds);
    expect(store.receiveMaterials(made)).toBe(true);
    edit(1, { stiffness_N_per_m: 150 });
    expect(sent).toHaveLength(1);
    expect(sent[0]).toMatchObject({ type: 'edit', serial: 11, label: 1, stiffness_N_per_m: 150, texture: 'grain' });
    expect(sent[0]).not.toHaveProperty('name');
    expect(store.receiveMaterials({ ...made, answers: 3 })).toBe(false);
    expect(store.receiveMaterials({ ...made, answers: 11, stiffness_N_per_m: [500, 150] })).toBe(true);
    expect(store.undoOrRedo('undo')).toBe('stiffness of ground');
    expect(sent[1]).toMatchObject({ type: 'edit', serial: 12, label: 1, stiffness_N_per_m: 400 });
    expect(store.undoOrRedo('redo')).toBe('stiffness of ground');
    store.reset();
    expect(store.settings.materials[1]).toMatchObject({ stiffness_N_per_m: 400 });
  });
  it('take the materials of another scene as they are', () => {
    const { store, sent, edit } = kept();
    store.receive(holds);
    store.receiveMaterials(made);
    edit(1, { friction: 0.9 });
    expect(store.receiveMaterials({ ...made, names: ['default'], answers: 0 })).toBe(true);
    expect(store.settings.materials).toHaveLength(1);
    expect(store.settings.materials[0]?.name).toBe('the surface');
    store.undoOrRedo('undo');
    expect(sent.filter(({ type }) => type === 'edit')).toHaveLength(1);
  });
});
