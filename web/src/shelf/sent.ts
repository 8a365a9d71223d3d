// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What `palpable make` reports in English while the home page waits for it: steps, and reasons why there is no scene. The page
// says those that are listed here in its own language; sent.test.ts compares them with the program's sources.
import { t } from '../language';

export const steps = [
  'reading the pictures',
  'reading the video',
  'reading the mesh',
  'reading the points',
  'reading the extract',
  'reading names',
  'looking for the same points in both pictures',
  'matching',
  'matching the pictures',
  'matching scanlines',
  'matching from coarse to fine',
  'segmenting the pictures',
  'cutting the graph',
  'refining',
  'refining borders',
  'finding surfaces',
  'finding occluded surfaces',
  'finding the ground',
  'finding the background',
  'finding boundaries',
  'finding streets',
  "finding the map's colours",
  'joining streets',
  'computing depth',
  'closing holes',
  'mapping detail',
  'limiting slopes',
  'relief',
  'repairing the mesh',
  'sampling the distance',
  'sampling the field',
  'filling the grid',
  'fitting superquadrics',
  'following points',
  'following trajectories',
  'fusing the depth maps',
  'Opening the touch',
  'Saving',
];

/** {…}: what differs from file to file. */
export const reasons = [
  'is empty',
  'is a folder, not a file',
  'is a text file, not a picture',
  'is not a picture of a kind that is understood (PNG, JPEG, TIFF, WebP, HEIC, OpenEXR, BMP, PGM/PPM, PFM, TGA)',
  'is a PNG picture that is damaged or cut off ({reason})',
  'is a JPEG picture that is damaged or cut off ({reason})',
  'is a HEIF picture that is damaged, cut off or of an unknown kind ({reason})',
  'is a TIFF picture that is damaged, cut off or of an unknown kind ({reason})',
  'is a WebP picture that is damaged or cut off',
  'is a moving WebP picture; save one frame of it',
  'is a GIF picture, which is not supported; save it as PNG',
  'is an anaglyph, which holds no two whole pictures',
  'is damaged: its decoder crashed on it (signal {number})',
  'is damaged: its decoder ended with {number}',
  'is damaged: its decoder gave nothing',
  'is damaged or too large: the system ended its decoder',
  'is damaged or too large: it gives more than its size explains',
  'is cut off: it holds less than its header states',
  'is not a map extract, which is OSM XML or PBF',
  'is an extract without streets',
  'is a mesh without triangles',
  'has more than 20 million triangles; simplify it first',
  'holds no pictures',
  'uses a codec that cannot be read',
  'is a coloured picture, not a map of depth or disparity',
  'is a photograph that holds no depth',
  'is a zip archive, but neither a scene nor a NumPy file',
  'is a zip archive without scene.json, so not a scene',
  'is the recording of a touch, not a scene',
  'has a scene.json that is damaged or incomplete',
  'needs more memory than there is',
  'there is not enough memory to match pictures of this size',
  'there is not enough memory for this',
  'working on the scene took too long, and was ended',
  'working on the scene ended with a fault (signal {number})',
  'working on the scene failed without a reason (exit code {number})',
  'choose a file first',
  'a file is no longer there: choose it again',
  'this scene is no longer on the shelf',
  'cancelled',
  'a stereo pair is two pictures, or one that holds both',
  'depth is one file, or a colour picture and its depth',
  'is not a picture, so the two are not a stereo pair',
];

const patterns = reasons
  .filter((reason) => reason.includes('{'))
  .map((reason) => {
    const [, before, name, after] = /^(.*)\{(\w+)\}(.*)$/.exec(reason)!;
    return { reason, before: before!, name: name!, after: after! };
  });

function reasonWords(text: string, say: typeof t): string | null {
  if (reasons.includes(text)) return say(text);
  const found = patterns.find(({ before, after }) => text.length > before.length + after.length && text.startsWith(before) && text.endsWith(after));
  return found ? say(found.reason, { [found.name]: text.slice(found.before.length, text.length - found.after.length) }) : null;
}

/** A sentence of the program, "file: reason", in the page's language as far as it is known. */
export function sentWords(sentence: string, say = t): string {
  const whole = reasonWords(sentence, say);
  if (whole !== null) return whole;
  // A file's name may hold a colon.
  for (let at = sentence.indexOf(': '); at >= 0; at = sentence.indexOf(': ', at + 1)) {
    const reason = reasonWords(sentence.slice(at + 2), say);
    if (reason !== null) return `${sentence.slice(0, at)}: ${reason}`;
  }
  return sentence;
}
