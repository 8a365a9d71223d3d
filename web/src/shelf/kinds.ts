// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What the chosen files may be, in plain words.

import { t } from '../language';

export interface Kind {
  /** `make.what` in protocol.json. */
  what: string;
  words: string;
}

const decide: Kind = { what: 'decide', words: t('Palpable finds out') };
const ofOnePicture: Kind[] = [
  { what: 'drawing', words: t('a drawing, or a picture whose outlines are to be felt') },
  { what: 'map', words: t('a picture of a street map') },
  { what: 'depth', words: t('a depth map') },
  { what: 'double', words: t('a pair of photographs in one picture') },
  decide,
];
const ofTwoPictures: Kind[] = [
  { what: 'pair', words: t('a pair of photographs, the left one first') },
  { what: 'depth', words: t('a photograph and its depth map') },
  decide,
];
const ofOther: Kind[] = [decide, { what: 'model', words: 'a model' }];

const isPicture = (file: { name: string; type: string }) =>
  file.type.startsWith('image/') || /\.(png|jpe?g|webp|tiff?|bmp|heic|heif|avif|gif|pgm|ppm)$/i.test(file.name);

/** What these files may be; the first one is the likeliest. */
export function kindsOf(files: readonly { name: string; type: string }[]): readonly Kind[] {
  const pictures = files.filter(isPicture).length;
  if (pictures === 1 && files.length === 1) return ofOnePicture;
  if (pictures === 2 && files.length === 2) return ofTwoPictures;
  return files.length === 1 ? ofOther : [decide];
}

export const megabytes = (bytes: number) => t('{value} MB', { value: Math.ceil(bytes / 1e6) });
/** The size of a file as the list of chosen files shows it. */
export const sizeWords = (bytes: number) => (bytes < 1e6 ? t('{value} kB', { value: Math.ceil(bytes / 1e3) }) : megabytes(bytes));

/** Why these files cannot be opened together; null: they can. */
export function obstacleTo(files: readonly { name: string; size: number }[], mostFiles: number, mostBytes: number): string | null {
  if (files.length > mostFiles) return t('{count} files are too many for one scene: at most {most} can be opened together.', { count: files.length, most: mostFiles });
  const large = files.find(({ size }) => size > mostBytes);
  if (large) return t('{name}: has {size}, and a page may open at most {most}: palpable make reads larger files', { name: large.name, size: megabytes(large.size), most: megabytes(mostBytes) });
  const empty = files.find(({ size }) => size === 0);
  return empty ? t('{name}: is empty', { name: empty.name }) : null;
}
