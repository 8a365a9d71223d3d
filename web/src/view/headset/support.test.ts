// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { Surface } from '../../surface';
import { PointingRest } from './pointing_rest';
import { faultOf, headsetMode, isMode } from './support';
import { sizeWords } from './words';

const offering = (...modes: string[]) => ({ isSessionSupported: (mode: string) => Promise.resolve(modes.includes(mode)) });

describe('a headset', () => {
  it('is there where the browser has one; a room around the scene is preferred, and a telephone is none', async () => {
    expect(await headsetMode(offering('immersive-vr'), true)).toBe('immersive-vr');
    expect(await headsetMode(offering('immersive-vr', 'immersive-ar'), true)).toBe('immersive-ar');
    expect(await headsetMode(offering('immersive-ar'), true)).toBe('no headset');
    expect(await headsetMode(offering(), true)).toBe('no headset');
    expect(await headsetMode(undefined, true)).toBe('no WebXR');
    expect(await headsetMode(undefined, false)).toBe('insecure');
    expect(await headsetMode({ isSessionSupported: () => Promise.reject(new DOMException('', 'SecurityError')) }, true)).toBe('forbidden');
    expect([isMode('immersive-ar'), isMode('no WebXR')]).toEqual([true, false]);
  });

  it('that is refused is told from one that is used or gone', () => {
    const faults = ['NotAllowedError', 'SecurityError', 'InvalidStateError', 'NotSupportedError', 'OperationError'].map((name) => faultOf(new DOMException('', name)));
    expect(faults).toEqual(['refused', 'refused', 'busy', 'gone', 'failed']);
    expect(faultOf(new Error('NotAllowedError'))).toBe('failed');
  });

  it('shows the scene in a size that is said', () => {
    const words = (size: number, percent: number) => sizeWords(new Surface(2, 2, new Float32Array(4), size, size / 2), percent);
    expect(words(0.1, 100)).toBe('In the headset its longer side is 10 centimetres; its true size.');
    expect(words(0.1, 1000)).toBe('In the headset its longer side is 1 metre; its true size is 10 centimetres.');
    expect(words(400, 100)).toBe('In the headset its longer side is 80 centimetres; its true size is 400 metres.');
  });
});

describe('a hand that points', () => {
  it('rests when it only trembles, and moves again when it leaves its place', () => {
    const rest = new PointingRest();
    const moves = (mm: number, now: number) => rest.moves({ x: mm / 1000, y: 0 }, 0.1, now);
    expect(moves(0, 0)).toBe(true);
    expect(moves(1, 300)).toBe(true);
    expect([moves(-1, 500), moves(1, 5000)]).toEqual([false, false]);
    expect([moves(2.1, 5016), moves(2.2, 5032)]).toEqual([true, true]);
    // Also slowly: it has left the place where it rested.
    expect([moves(3.5, 6000), moves(4.2, 6500), moves(4.3, 6516)]).toEqual([false, true, true]);
  });
});
