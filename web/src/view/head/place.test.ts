// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { calibrated, calibratedTilt, fitFace, focalLength, placeOf, type FacePoints, type Lens } from './place';

const lens: Lens = { width: 640, height: 480, angle: 60, tilt: 0, up: 0.16, right: 0 };
const eyeDistance = 0.063;
/** The average face, metres from the middle between its eyes: right, up, towards the camera. */
const head = [[0.5, 0, 0], [-0.5, 0, 0], [0, -0.45, 0], [0, -1, 0], [1.05, -0.35, 0], [-1.05, -0.35, 0]].map((point) => point.map((value) => value * eyeDistance));

/** What a camera sees of a head at a place of the screen's frame that is turned aside by `yaw` degrees: an independent projection. */
function seen(place: { x: number; y: number; z: number }, yaw = 0, { width, height, angle, tilt, up }: Lens = lens): FacePoints {
  const [cosYaw, sinYaw] = [Math.cos((yaw * Math.PI) / 180), Math.sin((yaw * Math.PI) / 180)];
  const [cos, sin] = [Math.cos((tilt * Math.PI) / 180), Math.sin((tilt * Math.PI) / 180)];
  const focal = width / 2 / Math.tan((angle * Math.PI) / 360);
  return head.map(([a, b, c]) => {
    // The face's own axes point as the person looks at the screen: its right is +x of the screen.
    const x = place.x - a! * -cosYaw + c! * sinYaw;
    const y = place.y + b! - up;
    const z = place.z + a! * sinYaw + c! * cosYaw;
    const away = z * cos - y * sin;
    return { x: width / 2 - (focal * x) / away, y: height / 2 - (focal * (y * cos + z * sin)) / away };
  });
}

describe('the place of a head', () => {
  it('is found from its picture', () => {
    for (const place of [{ x: 0, y: 0, z: 0.6 }, { x: 0.15, y: 0.1, z: 0.45 }, { x: -0.2, y: -0.05, z: 0.9 }]) {
      const found = placeOf(fitFace(seen(place)), lens, eyeDistance);
      for (const axis of ['x', 'y', 'z'] as const) expect(found[axis]).toBeCloseTo(place[axis], 9);
    }
  });
  it('is on the right when the person is, though the camera sees it on the left', () => {
    const points = seen({ x: 0.1, y: 0, z: 0.6 });
    expect(points[2]!.x).toBeLessThan(lens.width / 2);
    expect(placeOf(fitFace(points), lens, eyeDistance).x).toBeCloseTo(0.1, 9);
  });
  it('takes the tilt of the camera into account', () => {
    const tilted = { ...lens, tilt: 15 };
    const found = placeOf(fitFace(seen({ x: 0.05, y: -0.02, z: 0.7 }, 0, tilted)), tilted, eyeDistance);
    // The face is no longer parallel to the picture.
    expect(Math.hypot(found.x - 0.05, found.y + 0.02, found.z - 0.7)).toBeLessThan(0.015);
  });
  it('is less wrong than by the eyes alone when the head is turned aside', () => {
    const points = seen({ x: 0, y: 0, z: 0.6 }, 30);
    const byEyes = (focalLength(lens) * eyeDistance) / Math.hypot(points[0]!.x - points[1]!.x, points[0]!.y - points[1]!.y);
    const found = placeOf(fitFace(points), lens, eyeDistance);
    expect(byEyes - 0.6).toBeGreaterThan(0.08);
    expect(Math.abs(found.z - 0.6)).toBeLessThan(0.8 * (byEyes - 0.6));
  });
  it('does not change with a head that leans to its shoulder', () => {
    const points = seen({ x: 0.02, y: 0.03, z: 0.6 });
    const straight = fitFace(points);
    const { centre } = straight;
    const leaning = points.map(({ x, y }) => ({ x: centre.x + 0.8 * (x - centre.x) - 0.6 * (y - centre.y), y: centre.y + 0.6 * (x - centre.x) + 0.8 * (y - centre.y) }));
    const found = fitFace(leaning);
    expect(found.eyes).toBeCloseTo(straight.eyes, 9);
    expect(found.centre.x).toBeCloseTo(centre.x, 9);
    expect(found.centre.y).toBeCloseTo(centre.y, 9);
  });
});

describe('the calibration', () => {
  it('gives the angle and the tilt by which the head is straight before the screen', () => {
    const own = { ...lens, angle: 78, tilt: 9 };
    const face = fitFace(seen({ x: 0, y: 0, z: 0.55 }, 0, own));
    const found = calibrated(face, lens, eyeDistance, 0.55)!;
    expect(Math.abs(found.angle - own.angle)).toBeLessThan(1.5);
    expect(Math.abs(found.tilt - own.tilt)).toBeLessThan(1);
    const place = placeOf(face, { ...lens, ...found }, eyeDistance);
    expect(place.y).toBeCloseTo(0, 9);
    expect(place.z).toBeCloseTo(0.55, 9);
  });
  it('of a depth camera gives the tilt by which the head is as high as the middle of the screen', () => {
    const [up, away, tilt] = [0.2, 0.7, (11 * Math.PI) / 180];
    // From a camera that looks straight ahead, the head is below it by `up`; told by one that is taken to look down by 4°.
    const turned = tilt - (4 * Math.PI) / 180;
    const from = { x: 0.1, y: -up * Math.cos(turned) + away * Math.sin(turned), z: away * Math.cos(turned) + up * Math.sin(turned) };
    expect(calibratedTilt(from, 4, up)!).toBeCloseTo(11, 9);
    expect(calibratedTilt({ x: 0, y: 0.9, z: 0.2 }, 40, 0.2)).toBeNull();
  });
  it('refuses what no camera sees', () => {
    const face = fitFace(seen({ x: 0, y: 0, z: 0.2 }));
    expect(calibrated(face, lens, eyeDistance, 4)).toBeNull();
  });
});
