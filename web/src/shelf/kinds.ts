// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What the chosen files may be, in plain words.

export interface Kind {
  /** `make.what` in protocol.json. */
  what: string;
  words: string;
}

const decide: Kind = { what: 'decide', words: 'Palpable finds out' };
const ofOnePicture: Kind[] = [
  { what: 'drawing', words: 'a drawing, or a picture whose outlines are to be felt' },
  { what: 'map', words: 'a picture of a street map' },
  { what: 'depth', words: 'a depth map' },
  { what: 'double', words: 'a pair of photographs in one picture' },
  decide,
];
const ofTwoPictures: Kind[] = [
  { what: 'pair', words: 'a pair of photographs, the left one first' },
  { what: 'depth', words: 'a photograph and its depth map' },
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

export const megabytes = (bytes: number) => `${Math.ceil(bytes / 1e6)} MB`;
/** The size of a file as the list of chosen files shows it. */
export const sizeWords = (bytes: number) => (bytes < 1e6 ? `${Math.ceil(bytes / 1e3)} kB` : megabytes(bytes));

/** Why these files cannot be opened together; null: they can. */
export function obstacleTo(files: readonly { name: string; size: number }[], mostFiles: number, mostBytes: number): string | null {
  if (files.length > mostFiles) return `${files.length} files are too many for one scene: at most ${mostFiles} can be opened together.`;
  const large = files.find(({ size }) => size > mostBytes);
  if (large) return `${large.name}: has ${megabytes(large.size)}, and a page may open at most ${megabytes(mostBytes)}: palpable make reads larger files`;
  const empty = files.find(({ size }) => size === 0);
  return empty ? `${empty.name}: is empty` : null;
}
