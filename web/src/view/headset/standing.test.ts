// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { Quaternion, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { Surface } from '../../surface';
import { frontPose } from '../camera';
import { before, carried, sceneToRoom, usualScale, type Pose, type Standing } from './standing';

const scene = (sizeX: number, sizeY: number, isUpright = false) => new Surface(10, 10, new Float32Array(100).fill(0.02), sizeX, sizeY, isUpright);
const vertical = new Vector3(0, 1, 0);
const pose = (x: number, y: number, z: number, turn = 0, nod = 0): Pose => ({
  place: new Vector3(x, y, z),
  turned: new Quaternion().setFromAxisAngle(vertical, turn).multiply(new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), nod)),
});
const near = (found: Vector3, ...wanted: number[]) => found.toArray().forEach((value, k) => expect(value).toBeCloseTo(wanted[k]!, 9));
const at = (standing: Standing, surface: Surface, point: [number, number, number], view = frontPose) => new Vector3(...point).applyMatrix4(sceneToRoom(standing, view, surface));

describe('the scene in the room', () => {
  it('has its true size up to that of a table', () => {
    expect(usualScale(scene(0.1, 0.05))).toBe(1);
    expect(usualScale(scene(0.3, 0.8))).toBe(1);
    expect(usualScale(scene(400, 200)) * 400).toBeCloseTo(0.8);
  });

  it('lies on a table before the eyes, 40 cm below them, its upper side away and its heights up', () => {
    const surface = scene(0.2, 0.1);
    const standing = before(pose(1, 1.6, 2), surface, 1);
    near(at(standing, surface, [0, 0, 0]), 1, 1.2, 1.65);
    near(at(standing, surface, [0.1, 0.05, 0.02]), 1.1, 1.22, 1.6);
    // The nearest side is 30 cm away, whatever the size.
    near(at(before(pose(1, 1.6, 2), surface, 5), surface, [0, -0.05, 0]), 1, 1.2, 1.7);
  });

  it('is before a face that looks aside or down, and stays upright', () => {
    const surface = scene(0.2, 0.1);
    const standing = before(pose(0, 0, 0, Math.PI / 2, -0.6), surface, 1);
    // To the left of where the room's axes point.
    near(at(standing, surface, [0, 0, 0]), -0.35, -0.4, 0);
    near(at(standing, surface, [0.1, 0, 0.02]), -0.35, -0.38, -0.1);
  });

  it('stands as a solid with its front to the person', () => {
    const surface = scene(0.2, 0.1, true);
    const standing = before(pose(0, 0, 0), surface, 1);
    near(at(standing, surface, [0, 0.05, 0.02]), 0, -0.35, -0.3);
  });

  it('is turned, magnified and centred as on the screen', () => {
    const surface = scene(0.2, 0.1);
    const standing = before(pose(0, 0, 0), surface, 1);
    const view = { turn: 90, zoom: 2, centre: { x: 0.05, y: 0 } };
    near(at(standing, surface, [0.05, 0, 0], view), ...standing.place.toArray());
    // A view from the right: what is right is near.
    near(at(standing, surface, [0.1, 0, 0.01], view), 0, standing.place.y + 0.02, standing.place.z + 0.1);
  });
});

describe('hands', () => {
  const surface = scene(0.2, 0.1);
  const standing: Standing = { place: new Vector3(0, 1, -0.5), turn: 0.3, scale: 1 };
  const grip = (of: Standing, hand: Pose) => hand.place.clone().applyMatrix4(sceneToRoom(of, frontPose, surface).invert());

  it('carry the scene so that the gripped point stays in the hand, upright', () => {
    const [from, now] = [pose(0.05, 1.02, -0.45, 0.1, 0.4), pose(-0.2, 1.3, -0.3, 0.9, 0.4)];
    const moved = carried(standing, [from], [now], 1);
    near(grip(moved, now), ...grip(standing, from).toArray());
    expect(moved.turn).toBeCloseTo(1.1);
    expect(moved.scale).toBe(1);
    // A hand that only nods or rolls turns nothing.
    const nodded = carried(standing, [pose(0, 1, 0)], [pose(0, 1, 0, 0, 0.8)], 1);
    expect(nodded.turn).toBeCloseTo(0.3);
    near(nodded.place, 0, 1, -0.5);
  });

  it('magnify it together, with both gripped points in the hands, up to ten times the usual size', () => {
    const from = [pose(-0.1, 1, -0.5), pose(0.1, 1, -0.5)];
    const now = [pose(0, 1.1, -0.2), pose(0, 1.1, -0.6)];
    const moved = carried(standing, from, now, 1);
    expect(moved.scale).toBeCloseTo(2);
    from.forEach((hand, k) => near(grip(moved, now[k]!), ...grip(standing, hand).toArray()));
    expect(carried(standing, from, [pose(-9, 1, 0), pose(9, 1, 0)], 1).scale).toBe(10);
    expect(carried(standing, from, [pose(0, 1, 0), pose(0, 1, 0)], 0.01).scale).toBeCloseTo(0.001);
  });
});
