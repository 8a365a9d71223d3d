// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { coarseStep, fineStep, keyRows, press, type KeyTarget } from './keys';

describe('keys', () => {
  const calls: string[] = [];
  const target: KeyTarget = {
    move: ({ x, y, press }) => calls.push(`move ${x} ${y} ${press}`),
    describe: () => calls.push('describe'),
    where: () => calls.push('where'),
    recentre: () => calls.push('recentre'),
    walk: ({ ahead, left }) => calls.push(`walk ${ahead} ${left}`),
    pose: () => calls.push('pose'),
    choose: (probe) => calls.push(`choose ${probe}`),
    take: () => calls.push('take'),
    describeProbes: () => calls.push('describe probes'),
    pause: () => calls.push('pause'),
    mute: () => calls.push('mute'),
    zoom: (factor) => calls.push(`zoom ${factor > 1 ? 'in' : 'out'}`),
    resetView: () => calls.push('reset view'),
    moveView: () => calls.push('move view'),
    moveHead: () => calls.push('move head'),
    toSurface: () => calls.push('surface'),
    listPlaces: () => calls.push('list'),
    nameHere: () => calls.push('name'),
    sayWay: () => calls.push('way'),
    leave: () => calls.push('leave'),
    guide: () => calls.push('guide'),
    skipStep: () => calls.push('skip'),
    help: () => calls.push('help'),
  };
  const type = (key: string, shiftKey = false, ctrlKey = false) => press({ key, shiftKey, ctrlKey, altKey: false, metaKey: false }, target);
  it('move by one millimetre, with Shift by five', () => {
    calls.length = 0;
    type('ArrowUp');
    type('ArrowLeft', true);
    expect(calls).toEqual([`move 0 ${fineStep} 0`, `move ${-coarseStep} 0 0`]);
  });
  it('walk and turn, farther with Shift', () => {
    calls.length = 0;
    type('w');
    type('S', true);
    type('a');
    type('F', true);
    type('e');
    expect(calls).toEqual(['walk 0.005 0', 'walk -0.02 0', 'walk 0 15', 'walk 0 -45', 'pose']);
  });
  it('select the probe of their number, the tenth by 0', () => {
    calls.length = 0;
    for (const key of ['1', '9', '0', 'Delete', 'n']) type(key);
    expect(calls).toEqual(['choose 0', 'choose 8', 'choose 9', 'take', 'describe probes']);
  });
  it('zoom, move and reset the picture', () => {
    calls.length = 0;
    for (const key of ['+', '-', 'c', 'R']) type(key);
    expect(calls).toEqual(['zoom in', 'zoom out', 'move view', 'reset view']);
  });
  it('list, give and find names', () => {
    calls.length = 0;
    for (const key of ['l', 't', 'g', 'Escape', 'End']) type(key);
    expect(calls).toEqual(['list', 'name', 'way', 'leave', 'surface']);
  });
  it('begin the guided start, skip a step and leave it', () => {
    calls.length = 0;
    for (const key of ['i', 'K', 'Escape']) type(key);
    expect(calls).toEqual(['guide', 'skip', 'leave']);
  });
  it('ignore the browser\'s shortcuts', () => {
    calls.length = 0;
    expect(type('d', false, true)).toBe(false);
    expect(type('Tab')).toBe(false);
    expect(type('D', true)).toBe(true);
    expect(calls).toEqual(['describe']);
  });
  it('have one action each', () => {
    const all = keyRows.flatMap(({ keys }) => keys);
    expect(new Set(all).size).toBe(all.length);
  });
});
