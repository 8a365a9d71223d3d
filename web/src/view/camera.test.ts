// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { beforeEach, describe, expect, it } from 'vitest';
import { Surface } from '../surface';
import { Camera, cameraTilt, frontPose, leastZoom, mostZoom, shiftWords, turnWords } from './camera';

const surface = new Surface(2, 2, new Float32Array(4), 0.1, 0.08);
let camera: Camera;
beforeEach(() => {
  camera = new Camera();
});

describe('the view in words', () => {
  it('says how far the picture is turned and tilted', () => {
    expect(turnWords(frontPose, 40)).toBe('Not turned, tilted 40 degrees.');
    camera.turnBy(20);
    expect(turnWords(camera.pose, 40)).toBe('Turned 20 degrees clockwise, tilted 40 degrees.');
    camera.turnBy(-30);
    expect(turnWords(camera.pose, 0)).toBe('Turned 10 degrees anticlockwise, tilted 0 degrees.');
  });
  it('says where in the scene its middle is', () => {
    expect(shiftWords(frontPose)).toBe('The picture shows the middle of the scene.');
    camera.panBy(-0.02, 0.001, surface);
    expect(shiftWords(camera.pose)).toBe('The picture is centred 20 millimetres right, 1 millimetre down from the middle of the scene.');
  });
});

describe('the camera', () => {
  it('rotates without limit, with angles from -180 to 180 degrees', () => {
    camera.turnBy(170);
    camera.turnBy(30);
    expect(camera.pose.turn).toBe(-160);
  });
  it('keeps the place under the pointer while zooming', () => {
    const place = { x: 0.03, y: -0.02 };
    const offset = () => (place.x - camera.pose.centre.x) * camera.pose.zoom;
    const before = offset();
    camera.zoomBy(2, place, surface);
    expect(offset()).toBeCloseTo(before, 12);
    camera.zoomBy(0.5, place, surface);
    expect(camera.pose.centre.x).toBeCloseTo(0, 12);
  });
  it('clamps the zoom and stays over the scene', () => {
    for (let k = 0; k < 99; ++k) camera.zoomBy(2, null, surface);
    expect(camera.pose.zoom).toBe(mostZoom);
    for (let k = 0; k < 99; ++k) camera.zoomBy(0.5, null, surface);
    expect(camera.pose.zoom).toBe(leastZoom);
    camera.panBy(-9, 0, surface);
    expect(camera.pose.centre).toEqual({ x: 0.05, y: 0 });
  });
  it('shifts the picture relative to the view at any rotation', () => {
    camera.turnBy(90);
    camera.panBy(0.01, 0, surface);
    expect(camera.pose.centre.x).toBeCloseTo(0, 12);
    expect(camera.pose.centre.y).toBeCloseTo(-0.01, 12);
  });
  it('resets to the front', () => {
    camera.turnBy(45);
    camera.zoomBy(3, null, surface);
    camera.reset();
    expect(camera.pose).toEqual(frontPose);
  });

  it('begins above the front of an upright solid, and below the middle of what lies flat', () => {
    const solid = new Surface(2, 2, new Float32Array(4), 0.1, 0.08, true);
    expect(cameraTilt(25, solid)).toBe(-25);
    expect(cameraTilt(25, surface)).toBe(25);
  });
});
