// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Registration of a device's workspace with the screen: three points that the hand has touched on the screen give the similarity
// (rotation, translation, scale) between the scene, as the device moves in it, and the screen. The scene is then drawn where it is felt.
//
// The frame of the screen: metres, origin in its upper left corner, x right, y up (so all its points have y < 0), z towards the person.
import type { ScreenPoint } from './frustum';

export type Triple<T> = readonly [T, T, T];

export interface Registration {
  /** Metres on the screen per metre of the scene. */
  scale: number;
  /** The screen's axes in the scene. */
  right: ScreenPoint;
  up: ScreenPoint;
  towards: ScreenPoint;
  /** Where the scene's origin is in the frame of the screen. */
  origin: ScreenPoint;
}

/** `residual`: how far the farthest of the three points is from its mark by this registration, metres on the screen. */
export type Registered = { registration: Registration; residual: number };
/** `line`: the points are nearly on a line. `apart`: the residual is too large. `behind`: the scene would be seen from behind. */
export type RegistrationFault = 'line' | 'apart' | 'behind';

/** Greatest residual, metres. */
export const mostResidual = 0.005;
/** The least height of a triangle, as a share of its longest side. */
const leastHeight = 0.1;

const add = (a: ScreenPoint, b: ScreenPoint, factor = 1): ScreenPoint => ({ x: a.x + factor * b.x, y: a.y + factor * b.y, z: a.z + factor * b.z });
const dot = (a: ScreenPoint, b: ScreenPoint): number => a.x * b.x + a.y * b.y + a.z * b.z;
const cross = (a: ScreenPoint, b: ScreenPoint): ScreenPoint => ({ x: a.y * b.z - a.z * b.y, y: a.z * b.x - a.x * b.z, z: a.x * b.y - a.y * b.x });
const length = (a: ScreenPoint): number => Math.hypot(a.x, a.y, a.z);
const times = (a: ScreenPoint, factor: number): ScreenPoint => ({ x: a.x * factor, y: a.y * factor, z: a.z * factor });

interface Triangle {
  middle: ScreenPoint;
  /** Orthonormal: along the first side, in its plane, and at right angles to both. */
  axes: Triple<ScreenPoint>;
  /** The corners in its plane, from the middle. */
  corners: readonly { u: number; v: number }[];
}

/** Null: its corners are nearly on a line. */
function triangleOf(points: Triple<ScreenPoint>): Triangle | null {
  const [a, b, c] = points;
  const normal = cross(add(b, a, -1), add(c, a, -1));
  const longest = Math.max(length(add(b, a, -1)), length(add(c, b, -1)), length(add(a, c, -1)));
  if (!(length(normal) > leastHeight * longest * longest)) return null;
  const first = times(add(b, a, -1), 1 / length(add(b, a, -1)));
  const third = times(normal, 1 / length(normal));
  const second = cross(third, first);
  const middle = times(add(add(a, b), c), 1 / 3);
  const corners = points.map((point) => add(point, middle, -1)).map((from) => ({ u: dot(from, first), v: dot(from, second) }));
  return { middle, axes: [first, second, third], corners };
}

/**
 * The similarity with the least squared distances between the marks on the screen and what the hand touched, in the scene's frame:
 * the triangles' planes and middles coincide, and within the plane it is the Procrustes rotation.
 */
export function registrationOf(touched: Triple<ScreenPoint>, marks: Triple<ScreenPoint>): Registered | RegistrationFault {
  const [inScene, onScreen] = [triangleOf(touched), triangleOf(marks)];
  if (inScene === null || onScreen === null) return 'line';
  let [along, aside, size] = [0, 0, 0];
  inScene.corners.forEach(({ u, v }, k) => {
    const mark = onScreen.corners[k]!;
    along += u * mark.u + v * mark.v;
    aside += u * mark.v - v * mark.u;
    size += u * u + v * v;
  });
  const scale = Math.hypot(along, aside) / size;
  const angle = Math.atan2(aside, along);
  const [cosine, sine] = [Math.cos(angle), Math.sin(angle)];
  const [first, second, normal] = inScene.axes;
  // The scene's vectors that the rotation turns into the axes of the triangle on the screen.
  const turned: Triple<ScreenPoint> = [add(times(first, cosine), second, -sine), add(times(first, sine), second, cosine), normal];
  /** A direction of the screen, in the scene. */
  const fromScreen = (way: ScreenPoint) => onScreen.axes.reduce((sum, axis, k) => add(sum, turned[k]!, dot(way, axis)), { x: 0, y: 0, z: 0 });
  const axes = { right: fromScreen({ x: 1, y: 0, z: 0 }), up: fromScreen({ x: 0, y: 1, z: 0 }), towards: fromScreen({ x: 0, y: 0, z: 1 }) };
  const registration: Registration = { scale, ...axes, origin: { x: 0, y: 0, z: 0 } };
  registration.origin = add(onScreen.middle, inScreen(inScene.middle, registration), -1);
  const residual = Math.max(...touched.map((point, k) => length(add(inScreen(point, registration), marks[k]!, -1))));
  if (residual > mostResidual) return 'apart';
  // The scene rises along z, towards the person or towards the ceiling.
  if (axes.towards.z < 0 && axes.up.z < 0.5) return 'behind';
  return { registration, residual };
}

/** A registration of what the hand touched in its device's own workspace, for a scene in which that workspace's origin is at `device`. */
export const beneath = (registration: Registration, device: ScreenPoint): Registration => ({ ...registration, origin: inScreen(times(device, -1), registration) });

/** Where a point of the scene is in the frame of the screen. */
export function inScreen(point: ScreenPoint, { scale, right, up, towards, origin }: Registration): ScreenPoint {
  return add(origin, { x: dot(point, right), y: dot(point, up), z: dot(point, towards) }, scale);
}

/** Which point of the scene is at a point of the screen's frame. */
export function inScene(point: ScreenPoint, { scale, right, up, towards, origin }: Registration): ScreenPoint {
  const { x, y, z } = times(add(point, origin, -1), 1 / scale);
  return add(add(times(right, x), up, y), towards, z);
}
