// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { darkPath } from './qr_picture';
import { countWords, guestWords, selfWords } from './words';

const guest = { guest: 1, name: 'Phone 1', role: 'touch', presence: 'here', probe: 8 };

describe('the picture of a QR code', () => {
  it('has one rectangle for each run of dark modules, beside its margin', () => expect(darkPath(3, '110' + '000' + '101')).toBe('M4 4h2v1h-2zM4 6h1v1h-1zM6 6h1v1h-1z'));
});

describe('the words on guests', () => {
  it('name the role, the probe and the presence', () => {
    expect(guestWords(guest)).toBe('Phone 1 touches with probe 9: here');
    expect(guestWords({ ...guest, probe: null, presence: 'asleep' })).toBe('Phone 1 looks: asleep, or showing something else');
    expect(selfWords(guest)).toBe('You are Phone 1: you touch with probe 9.');
    expect(countWords(0, 8)).toBe('Nobody else is here. There are 8 places.');
    expect(countWords(3, 8)).toBe('3 of 8 places are taken.');
  });
});
