// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The user's preferences for look and sound. Stored in a cookie, since local storage is separate for each port and
// palpable's port changes. Nothing is stored before a change, and a reset removes the cookie.

/** head: for one place of the head, without glasses; parallel, crossed: two pictures for free viewing; from side-by-side: for 3-D screens. */
export const depthModes = [
  'plain', 'head', 'red-cyan', 'amber-blue', 'green-magenta', 'parallel', 'crossed', 'side-by-side', 'over-under', 'rows', 'columns',
] as const;

export interface Preferences {
  surface: 'picture' | 'unlit' | 'clay' | 'cells';
  view: '3d' | 'flat';
  tilt: number;
  sound: boolean;
  volume: number;
  /** Of each sound, per cent of the whole. */
  contactVolume: number;
  slideVolume: number;
  heightVolume: number;
  edgeVolume: number;
  nameVolume: number;
  findVolume: number;
  /** Of the phone, and of a headset's controllers. */
  vibration: boolean;
  /** Of gamepads. A browser that was asked for gamepads once polls them until the page is closed: off unless chosen. */
  gamepads: boolean;
  speech: boolean;
  /** How the 3D view shows depth; plain: a usual picture. */
  depthMode: (typeof depthModes)[number];
  /** Of the person's eyes from each other, and from the screen: millimetres. */
  eyeDistance: number;
  screenDistance: number;
  /** The share of the scene's depth that is before the screen, and the share of its true depth that is shown: per cent. */
  depthBefore: number;
  depthShare: number;
  /** Whether disparities are kept within a degree. */
  depthComfort: boolean;
  /** Whether the right eye sees the second picture of the pair that a scene was made from. */
  secondView: boolean;
  swapEyes: boolean;
  /** Of the scene in a headset: per cent of its true size, or of a table's where it is larger. */
  headsetSize: number;
  /** Of the camera that follows the head: its horizontal angle of view and how far it looks down, degrees; and how far it is above the screen's upper edge and to the right of its middle, millimetres. */
  cameraAngle: number;
  cameraTilt: number;
  cameraAbove: number;
  cameraRight: number;
  /** How far the view moves with the head to the sides, up and down, nearer and farther: per cent. */
  headGainX: number;
  headGainY: number;
  headGainZ: number;
  /** Millimetres of the screen per device pixel, as measured; 0: not measured. */
  pixelSize: number;
  theme: 'system' | 'light' | 'dark' | 'contrast';
}

export const defaults: Preferences = {
  surface: 'picture',
  view: '3d',
  tilt: 25,
  sound: true,
  volume: 50,
  contactVolume: 100,
  slideVolume: 100,
  heightVolume: 100,
  edgeVolume: 100,
  nameVolume: 100,
  findVolume: 100,
  vibration: true,
  gamepads: false,
  speech: false,
  depthMode: 'plain',
  eyeDistance: 63,
  screenDistance: 600,
  depthBefore: 40,
  depthShare: 100,
  depthComfort: true,
  secondView: true,
  swapEyes: false,
  headsetSize: 100,
  cameraAngle: 60,
  cameraTilt: 0,
  cameraAbove: 10,
  cameraRight: 0,
  headGainX: 100,
  headGainY: 100,
  headGainZ: 100,
  pixelSize: 0,
  theme: 'system',
};

const name = 'palpable_page';
const choices = {
  surface: ['picture', 'unlit', 'clay', 'cells'],
  view: ['3d', 'flat'],
  depthMode: depthModes,
  theme: ['system', 'light', 'dark', 'contrast'],
};
const percent = { min: 0, max: 100 };
/** Degrees from above, per cent, and millimetres. */
export const ranges = {
  tilt: { min: 0, max: 80 },
  volume: percent,
  contactVolume: percent,
  slideVolume: percent,
  heightVolume: percent,
  edgeVolume: percent,
  nameVolume: percent,
  findVolume: percent,
  eyeDistance: { min: 40, max: 80 },
  screenDistance: { min: 200, max: 4000 },
  depthBefore: percent,
  depthShare: { min: 10, max: 200 },
  headsetSize: { min: 10, max: 1000 },
  cameraAngle: { min: 30, max: 120 },
  cameraTilt: { min: -45, max: 45 },
  cameraAbove: { min: -400, max: 400 },
  cameraRight: { min: -500, max: 500 },
  headGainX: { min: 0, max: 200 },
  headGainY: { min: 0, max: 200 },
  headGainZ: { min: 0, max: 200 },
  pixelSize: { min: 0, max: 5 },
};

/** The preferences in a document.cookie; defaults for missing or invalid values. */
export function readPreferences(cookies: string): Preferences {
  const found: Preferences = { ...defaults };
  const text = cookies.split('; ').find((pair) => pair.startsWith(`${name}=`))?.slice(name.length + 1);
  if (text === undefined) return found;
  let kept: unknown;
  try {
    kept = JSON.parse(decodeURIComponent(text));
  } catch {
    return found;
  }
  if (typeof kept !== 'object' || kept === null) return found;
  for (const [key, value] of Object.entries(kept)) if (isSensible(key, value)) Object.assign(found, { [key]: value });
  return found;
}

function isSensible(key: string, value: unknown): boolean {
  if (!Object.hasOwn(defaults, key)) return false;
  if (key in choices) return (choices[key as keyof typeof choices] as readonly unknown[]).includes(value);
  const range = ranges[key as keyof typeof ranges];
  if (range !== undefined) return typeof value === 'number' && value >= range.min && value <= range.max;
  return typeof value === 'boolean';
}

/** The value for document.cookie: only differences from the defaults are stored. */
export function preferencesCookie(preferences: Preferences): string {
  const own = Object.entries(preferences).filter(([key, value]) => value !== defaults[key as keyof Preferences]);
  const age = own.length > 0 ? 365 * 24 * 3600 : 0;
  return `${name}=${encodeURIComponent(JSON.stringify(Object.fromEntries(own)))}; Path=/; SameSite=Strict; Max-Age=${age}`;
}
