// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What is shown of guests in words.
import type { Guest } from '../generated/protocol';

const presences: Record<string, string> = {
  coming: 'on the way',
  here: 'here',
  asleep: 'asleep, or showing something else',
  away: 'away; may come back',
};

/** "Phone 1 touches with probe 9: here". */
export function guestWords({ name, probe, presence }: Guest): string {
  return `${name} ${probe === null ? 'looks' : `touches with probe ${probe + 1}`}: ${presences[presence] ?? presence}`;
}

/** What a guest's own page says of it. */
export function selfWords({ name, probe }: Guest): string {
  return `You are ${name}: you ${probe === null ? 'see and hear, and do not touch' : `touch with probe ${probe + 1}`}.`;
}

/** How many guests there are, of how many. */
export function countWords(guests: number, places: number): string {
  return guests === 0 ? `Nobody else is here. There are ${places} places.` : `${guests} of ${places} places are taken.`;
}
