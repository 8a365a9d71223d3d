// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// How the scene stands in the room of a headset: metres, x right, y up, z backwards as the person stood first.
import { Matrix4, Quaternion, Vector3 } from 'three';
import type { Surface } from '../../surface';
import type { CameraPose } from '../camera';

/** Where something is, and how it is turned from the room's axes. */
export interface Pose {
  place: Vector3;
  turned: Quaternion;
}

export interface Standing {
  /** Of the scene's middle. */
  place: Vector3;
  /** About the vertical, radians, counter-clockwise from above. */
  turn: number;
  /** The scene's size relative to its true one. */
  scale: number;
}

/** The longer side of a table, metres: larger scenes are shown in this size. */
const tableSide = 0.8;
/** From the eyes to the scene's nearest side, and down to its middle: metres. */
const reach = 0.3;
const below = 0.4;
/** Limits of the magnification by both hands, relative to the usual size. */
const least = 0.1;
const most = 10;

const vertical = new Vector3(0, 1, 0);
const about = (angle: number) => new Quaternion().setFromAxisAngle(vertical, angle);
/** From the scene's axes to the room's: a relief lies on the table with its upper side away, a solid stands. */
const onTable = new Matrix4().makeRotationX(-Math.PI / 2);

/** True size, or a table's for scenes that are larger. */
export const usualScale = ({ sizeX, sizeY }: Surface): number => Math.min(1, tableSide / Math.max(sizeX, sizeY));

/** Before a person, in the direction of the face. */
export function before({ place, turned }: Pose, surface: Surface, scale: number): Standing {
  const ahead = new Vector3(0, 0, -1).applyQuaternion(turned);
  const turn = Math.hypot(ahead.x, ahead.z) < 0.1 ? 0 : Math.atan2(-ahead.x, -ahead.z);
  const towards = (surface.isUpright ? Math.max(0, surface.range().highest) : surface.sizeY / 2) * scale;
  const middle = new Vector3(0, -below, -(reach + towards)).applyQuaternion(about(turn));
  return { place: middle.add(place), turn, scale };
}

/** Carried by one hand or by both since they were at `from`: it stays upright; both also magnify it. */
export function carried(standing: Standing, from: readonly Pose[], now: readonly Pose[], usual: number): Standing {
  const [first, second] = [middleOf(from), middleOf(now)];
  const wanted = standing.scale * (from.length > 1 ? apart(now) / Math.max(0.01, apart(from)) : 1);
  const scale = Math.min(most * usual, Math.max(least * usual, wanted));
  const angle = from.length > 1 ? heading(now) - heading(from) : twist(from[0]!.turned, now[0]!.turned);
  const place = standing.place.clone().sub(first).applyAxisAngle(vertical, angle).multiplyScalar(scale / standing.scale).add(second);
  return { place, turn: standing.turn + angle, scale };
}

/** From the scene to the room; the picture's turn, zoom and centre act as they do on the screen. */
export function sceneToRoom({ place, turn, scale }: Standing, pose: CameraPose, { isUpright }: Surface): Matrix4 {
  const size = scale * pose.zoom;
  const matrix = new Matrix4().compose(place, about(turn), new Vector3(size, size, size));
  if (!isUpright) matrix.multiply(onTable);
  return matrix.multiply(new Matrix4().makeRotationZ((-pose.turn * Math.PI) / 180)).multiply(new Matrix4().makeTranslation(-pose.centre.x, -pose.centre.y, 0));
}

function middleOf(hands: readonly Pose[]): Vector3 {
  return hands.reduce((sum, { place }) => sum.add(place), new Vector3()).divideScalar(hands.length);
}
const between = (hands: readonly Pose[]) => hands[1]!.place.clone().sub(hands[0]!.place);
const apart = (hands: readonly Pose[]) => between(hands).length();
/** Of the line from the first hand to the second, radians about the vertical. */
function heading(hands: readonly Pose[]): number {
  const { x, z } = between(hands);
  return Math.atan2(-z, x);
}
/** How far a hand has turned about the vertical, -π to π, whatever else it has turned. */
function twist(from: Quaternion, now: Quaternion): number {
  const { y, w } = now.clone().multiply(from.clone().invert());
  const angle = 2 * Math.atan2(y, w);
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}
