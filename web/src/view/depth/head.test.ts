// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { clampHead, headStep, headWords, restingHead } from './head';
import { comfortWords, depthWords } from './words';

describe('the head', () => {
  it('moves by a centimetre, with Shift nearer and farther', () => {
    expect(headStep(1, 0, false)).toEqual({ x: 0.01, y: -0, z: 0 });
    expect(headStep(0, -1, false)).toEqual({ x: 0, y: 0.01, z: 0 });
    expect(headStep(0, -1, true)).toEqual({ x: 0, y: 0, z: -0.05 });
  });
  it('stays before the screen', () => {
    expect(clampHead({ x: 3, y: -3, z: -3 }, 0.6)).toEqual({ x: 0.4, y: -0.4, z: -0.3 });
    expect(clampHead({ x: 0, y: 0, z: 9 }, 0.6).z).toBe(0.6);
  });
  it('is said in centimetres', () => {
    expect(headWords(restingHead)).toBe('Your head is straight before the picture.');
    expect(headWords({ x: -0.01, y: 0.03, z: -0.1 })).toBe('Your head is 1 centimetre left, 3 centimetres up, 10 centimetres nearer.');
  });
});

describe('the depth in words', () => {
  const fit = { scale: 1, plane: 0, depth: 0.641, nearest: 1, farthest: -0.8, isByHand: false };
  const viewer = { depthShare: 100, eyeDistance: 63, screenDistance: 600 };
  it('says that it is where the hand feels it', () => {
    const byHand = { ...fit, depth: 1, nearest: 2, isByHand: true };
    expect(depthWords(byHand, { depthMode: 'head', ...viewer })).toBe('The scene stands where the hand feels it, as seen with one eye from your head’s place.');
    expect(depthWords(byHand, { depthMode: 'rows', ...viewer })).toBe(
      'The scene where the hand feels it: disparities up to 2.0° before the screen and 0.8° behind it. More than one degree tires the eyes.',
    );
  });
  it('says how much of it is shown, and whether that tires', () => {
    expect(depthWords(null, { depthMode: 'plain', ...viewer })).toBe('A usual picture, the same for both eyes.');
    expect(depthWords(fit, { depthMode: 'rows', ...viewer })).toBe(
      '64 % of the true depth, so that it is easy on the eyes: disparities up to 1.0° before the screen and 0.8° behind it.',
    );
    expect(depthWords({ ...fit, depth: 1, nearest: 2 }, { depthMode: 'rows', ...viewer })).toMatch(/^The true depth: .* tires the eyes\.$/);
    expect(depthWords(fit, { depthMode: 'head', ...viewer })).toMatch(/one eye/);
  });
  it('says how far apart two pictures are that are looked at straight ahead', () => {
    expect(depthWords(fit, { depthMode: 'parallel', ...viewer })).toMatch(/ The pictures are at most 53 mm apart, so that the eyes need not turn outwards\.$/);
    expect(depthWords(fit, { depthMode: 'crossed', ...viewer })).not.toMatch(/apart/);
  });
  it('says what the right eye sees of a pair', () => {
    expect(depthWords(fit, { depthMode: 'rows', ...viewer }, true)).toMatch(/ The right eye sees the second photograph, .* from the first\.$/);
    expect(depthWords(fit, { depthMode: 'head', ...viewer }, true)).not.toMatch(/photograph/);
  });
  it('has a short form for what magnifying changes', () => {
    expect(comfortWords(fit, { depthMode: 'rows', depthShare: 100 })).toBe('64 % of the true depth, so that it is easy on the eyes.');
    expect(comfortWords({ ...fit, depth: 1 }, { depthMode: 'rows', depthShare: 100 })).toBe('The true depth.');
    expect(comfortWords(null, { depthMode: 'plain', depthShare: 100 })).toBe('');
  });
});
