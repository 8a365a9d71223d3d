// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { kindsOf, obstacleTo, sizeWords } from './kinds';

const picture = { name: 'a.png', type: 'image/png' };
const what = (...files: { name: string; type: string }[]) => kindsOf(files).map((kind) => kind.what);

describe('what files may be', () => {
  it('a picture is a drawing at first', () => expect(what(picture)[0]).toBe('drawing'));
  it('a photograph of a phone has no type in some browsers', () => expect(what({ name: 'IMG_1.HEIC', type: '' })[0]).toBe('drawing'));
  it('two pictures are a pair at first', () => expect(what(picture, picture)[0]).toBe('pair'));
  it('a scene, a model or a video is recognised by the program', () => expect(what({ name: 'a.palp', type: '' })[0]).toBe('decide'));
  it('several files are recognised by the program', () => expect(what(picture, picture, picture)).toEqual(['decide']));
});

describe('what cannot be opened', () => {
  const file = (size: number) => ({ name: 'a.png', size });
  it('nothing speaks against usual files', () => expect(obstacleTo([file(1), file(300)], 2, 300)).toBeNull());
  it('too many', () => expect(obstacleTo([file(1), file(1), file(1)], 2, 300)).toMatch(/3 files are too many/));
  it('too large, before anything is sent', () => expect(obstacleTo([file(500e6)], 8, 300e6)).toBe('a.png: has 500 MB, and a page may open at most 300 MB: palpable make reads larger files'));
  it('says sizes in few figures', () => expect([sizeWords(1), sizeWords(6371), sizeWords(2_500_000)]).toEqual(['1 kB', '7 kB', '3 MB']));
  it('empty', () => expect(obstacleTo([file(0)], 8, 300)).toBe('a.png: is empty'));
});
