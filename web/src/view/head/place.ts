// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Where a head is, from six points of its face in a camera's picture: a pinhole camera and the distance between the eyes.
import type { ScreenPoint } from '../depth/frustum';

/** Pixels of the camera's picture, right and down from its upper left corner. Not mirrored: the person's right is left. */
export interface ImagePoint {
  x: number;
  y: number;
}

/** The person's right eye, left eye, tip of the nose, mouth, right and left ear, in this order. */
export type FacePoints = readonly ImagePoint[];

export interface Lens {
  /** Of the picture, pixels. */
  width: number;
  height: number;
  /** The horizontal angle of view, degrees. */
  angle: number;
  /** How far the camera looks down from the normal of the screen, degrees. */
  tilt: number;
  /** Of the camera from the middle of the screen, which is in the frame of the screen, metres. */
  up: number;
  right: number;
}

/**
 * A face of average proportions from the front, in units of the distance between its eyes, from the middle between them; and
 * how much each point counts. The eyes are what sees; the mouth moves in speech, and ears are found roughly.
 */
const face: readonly { x: number; y: number; weight: number }[] = [
  { x: -0.5, y: 0, weight: 1 },
  { x: 0.5, y: 0, weight: 1 },
  { x: 0, y: 0.45, weight: 0.5 },
  { x: 0, y: 1, weight: 0.25 },
  { x: -1.05, y: 0.35, weight: 0.25 },
  { x: 1.05, y: 0.35, weight: 0.25 },
];
const total = face.reduce((sum, { weight }) => sum + weight, 0);
const middle = {
  x: face.reduce((sum, { x, weight }) => sum + x * weight, 0) / total,
  y: face.reduce((sum, { y, weight }) => sum + y * weight, 0) / total,
};

export interface FaceFit {
  /** The middle between the eyes, pixels. */
  centre: ImagePoint;
  /** The distance between the eyes of a face that looks at the camera, pixels. */
  eyes: number;
}

/**
 * The average face, shifted, turned in the picture and magnified so that its points are nearest to the found ones (weighted
 * least squares). A head that turns aside shortens the distance between its eyes, but not that to the mouth.
 */
export function fitFace(points: FacePoints): FaceFit {
  const mean = { x: 0, y: 0 };
  face.forEach(({ weight }, k) => {
    mean.x += (weight / total) * points[k]!.x;
    mean.y += (weight / total) * points[k]!.y;
  });
  // A point as a complex number: the turn and the scale are one factor, re + i im.
  let [re, im, norm] = [0, 0, 0];
  face.forEach(({ x, y, weight }, k) => {
    const [px, py, qx, qy] = [x - middle.x, y - middle.y, points[k]!.x - mean.x, points[k]!.y - mean.y];
    re += weight * (px * qx + py * qy);
    im += weight * (px * qy - py * qx);
    norm += weight * (px * px + py * py);
  });
  re /= norm;
  im /= norm;
  return {
    centre: { x: mean.x - (re * middle.x - im * middle.y), y: mean.y - (re * middle.y + im * middle.x) },
    eyes: Math.hypot(re, im),
  };
}

/** Pixels. */
export const focalLength = ({ width, angle }: Pick<Lens, 'width' | 'angle'>): number => width / 2 / Math.tan((angle * Math.PI) / 360);

/** The middle between the eyes in the frame of the screen, metres. `eyeDistance`: metres. */
export function placeOf({ centre, eyes }: FaceFit, lens: Lens, eyeDistance: number): ScreenPoint {
  const away = (focalLength(lens) * eyeDistance) / eyes;
  const metres = eyeDistance / eyes;
  const right = -(centre.x - lens.width / 2) * metres;
  const up = -(centre.y - lens.height / 2) * metres;
  const [sin, cos] = [Math.sin((lens.tilt * Math.PI) / 180), Math.cos((lens.tilt * Math.PI) / 180)];
  return { x: lens.right + right, y: lens.up + up * cos - away * sin, z: away * cos + up * sin };
}

/**
 * The tilt for which a head is straight before the middle of the screen, as high as it; null if no camera looks so. `from`: the
 * head from a depth camera that was taken to look down by `tilt`; `up`: of the camera, metres.
 */
export function calibratedTilt(from: ScreenPoint, tilt: number, up: number): number | null {
  const below = Math.atan2(-from.y, from.z);
  const wanted = Math.asin(Math.min(1, Math.max(-1, up / Math.hypot(from.y, from.z))));
  const found = tilt + (180 / Math.PI) * (wanted - below);
  return Math.abs(found) <= mostTilt ? found : null;
}

const angles = { least: 30, most: 120 };
const mostTilt = 45;

/**
 * The angle of view and the tilt for which a face is straight before the middle of the screen at a distance (metres) from it;
 * null if no camera can see it so.
 */
export function calibrated({ centre, eyes }: FaceFit, lens: Lens, eyeDistance: number, distance: number): Pick<Lens, 'angle' | 'tilt'> | null {
  // From the camera the head is `away` along its axis and `up` from it: away² + up² = distance² + lens.up².
  const up = (-(centre.y - lens.height / 2) * eyeDistance) / eyes;
  const away = Math.sqrt(distance ** 2 + lens.up ** 2 - up ** 2);
  const angle = (360 / Math.PI) * Math.atan((lens.width * eyeDistance) / (2 * eyes * away));
  const tilt = (180 / Math.PI) * (Math.atan2(lens.up, distance) + Math.atan2(up, away));
  return angle >= angles.least && angle <= angles.most && Math.abs(tilt) <= mostTilt ? { angle, tilt } : null;
}
