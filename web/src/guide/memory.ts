// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// How far a person is in the guided start. It is kept as the preferences are (settings/preferences.ts), but is nothing that undo or a
// reset of the settings changes, so it has a cookie of its own.
import { stepNames } from './steps';

export interface Progress {
  /** Whether the person has been asked. */
  offered: boolean;
  /** The next step of each way: 0 before the beginning, the number of steps at the end. */
  eyes: number;
  ears: number;
}

export const noProgress: Progress = { offered: false, eyes: 0, ears: 0 };

const name = 'palpable_guide';

/** The progress in a document.cookie: "palpable_guide=EYES.EARS"; none if it is missing or invalid. */
export function readProgress(cookies: string): Progress {
  const found = cookies.split('; ').find((pair) => pair.startsWith(`${name}=`))?.slice(name.length + 1) ?? '';
  const [eyes, ears] = /^\d{1,2}\.\d{1,2}$/.test(found) ? found.split('.').map(Number) : [];
  if (eyes === undefined || ears === undefined || Math.max(eyes, ears) > stepNames.length) return noProgress;
  return { offered: true, eyes, ears };
}

/** The value for document.cookie. */
export const progressCookie = ({ eyes, ears }: Progress): string => `${name}=${eyes}.${ears}; Path=/; SameSite=Strict; Max-Age=${365 * 24 * 3600}`;
