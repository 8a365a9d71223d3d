// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What is shown of guests in words.
import type { Guest, Invitation } from '../generated/protocol';
import { known, t } from '../language';

const presences: Record<string, string> = {
  coming: t('on the way'),
  here: t('here'),
  asleep: t('asleep, or showing something else'),
  away: t('away; may come back'),
};

/** "Phone 1": the program's name in the page's language. */
export function guestName({ name }: Pick<Guest, 'name'>): string {
  const numbered = /^(\p{L}+) (\d+)$/u.exec(name);
  return numbered === null ? known(name) : `${known(numbered[1]!)} ${numbered[2]!}`;
}

/** "Phone 1 touches with probe 9: here". */
export function guestWords(guest: Guest): string {
  const values = { name: guestName(guest), presence: presences[guest.presence] ?? guest.presence };
  if (guest.probe === null) return t('{name} looks: {presence}', values);
  return t('{name} touches with probe {probe}: {presence}', { ...values, probe: guest.probe + 1 });
}

/** What a guest's own page says of it. */
export function selfWords(guest: Guest): string {
  const name = guestName(guest);
  if (guest.probe === null) return t('You are {name}: you see and hear, and do not touch.', { name });
  return t('You are {name}: you touch with probe {probe}.', { name, probe: guest.probe + 1 });
}

/** How many guests there are, of how many. */
export function countWords(guests: number, places: number): string {
  if (guests === 0) return t('Nobody else is here. There are {places} places.', { places });
  return t('{guests, plural, one {# of {places} places is} other {# of {places} places are}} taken.', { guests, places });
}

/** What a link is good for. */
export function invitationWords({ role, minutes }: Invitation): string {
  return role === 'look'
    ? t('It lets one device look, once, within {minutes} minutes.', { minutes })
    : t('It lets one device touch, once, within {minutes} minutes.', { minutes });
}
