// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The values of all settings, without page elements.
import type { Law } from '../generated/protocol';
import type { Material } from './materials';
import type { Preferences } from './preferences';

/** The settings that the program holds (protocol.json, "change"). */
export interface TouchSettings {
  law: string;
  /** The law's parameters that are set, by name; the others come from the scene or the law. */
  set: Readonly<Record<string, number>>;
  heightFactor: number;
}

export interface Settings {
  touch: TouchSettings;
  page: Preferences;
  /** By label. */
  materials: Material[];
}

/** Changes the law and keeps the parameters with the same meaning. */
export function withLaw(touch: TouchSettings, from: Law | undefined, to: Law): TouchSettings {
  const same = to.parameters.filter(({ name, unit }) => from?.parameters.some((before) => before.name === name && before.unit === unit));
  const set = Object.fromEntries(Object.entries(touch.set).filter(([name]) => same.some((parameter) => parameter.name === name)));
  return { ...touch, law: to.name, set };
}

export function sameTouch(a: TouchSettings, b: TouchSettings): boolean {
  const names = new Set([...Object.keys(a.set), ...Object.keys(b.set)]);
  return a.law === b.law && a.heightFactor === b.heightFactor && [...names].every((name) => a.set[name] === b.set[name]);
}
