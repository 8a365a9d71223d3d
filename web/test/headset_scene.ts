// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Runs in the browser, without the program: the scene of depth_scene.ts in an emulated headset, for headset.browser.ts.
import { metaQuest3, XRDevice } from 'iwer';
import { pixelsIn, theView } from './depth_scene';

export interface HeadsetShot {
  /** From where the eyes were at the beginning, metres; radians about the vertical and then nodding. */
  head: { place: [number, number, number]; turn: number; nod: number };
  eyeDistance: number;
}

export interface HeadsetTaken {
  width: number;
  height: number;
  /** Of the whole canvas: the left eye's half and the right eye's. */
  pixels: string;
  /** Where the scene stands: its middle, its turn about the vertical and its scale. */
  stands: { place: [number, number, number]; turn: number; scale: number };
  /** Degrees. */
  verticalAngle: number;
}

declare global {
  interface Window {
    headsetScene: {
      show(): Promise<string | null>;
      /** Two frames with this head; `anew`: the scene is placed before it. */
      take(shot: HeadsetShot, anew: boolean): Promise<HeadsetTaken>;
      leave(): Promise<string[]>;
    };
  }
}

const device = new XRDevice(metaQuest3);
device.installRuntime({ forceInstall: true });
device.stereoEnabled = true;
// Narrower than a headset's angle, so that the discs have enough pixels.
device.fovy = 0.6;
/** Of the emulated person at the beginning, metres above the floor. */
const eyesAbove = device.position.y;
let [left, frames] = [false, 0];
const told: string[] = [];
let nextFrame = () => {};
let taken = '';
let wanted = false;

window.headsetScene = {
  show: () =>
    theView().headset.show('immersive-vr', {
      drives: (now) => told.push(now ? 'drives' : 'rests'),
      frame: () => {
        theView().draw(0);
        frames += 1;
        // What is drawn is there within the frame only.
        if (wanted) taken = pixelsIn(theView().canvas, theView().canvas.width, theView().canvas.height);
        wanted = false;
        nextFrame();
      },
      ended: () => (left = true),
      aim: () => undefined,
      press: () => undefined,
      release: () => undefined,
    }),

  async take({ head, eyeDistance }, anew) {
    const frame = () => new Promise<void>((done) => (nextFrame = done));
    device.ipd = eyeDistance;
    const [x, y, z] = head.place;
    device.position.set(x, eyesAbove + y, z);
    const [turn, nod] = [head.turn / 2, head.nod / 2];
    device.quaternion.set(Math.cos(turn) * Math.sin(nod), Math.sin(turn) * Math.cos(nod), -Math.sin(turn) * Math.sin(nod), Math.cos(turn) * Math.cos(nod));
    await frame();
    if (anew) theView().headset.again();
    await frame();
    wanted = true;
    await frame();
    const { width, height } = theView().canvas;
    const { place, turn: stands, scale } = theView().headset.stands!;
    return { width, height, pixels: taken, stands: { place: place.toArray(), turn: stands, scale }, verticalAngle: (device.fovy * 180) / Math.PI };
  },

  async leave() {
    theView().headset.leave();
    while (!left) await new Promise((done) => setTimeout(done, 10));
    const before = frames;
    const ask = window.requestAnimationFrame.bind(window);
    let asked = 0;
    window.requestAnimationFrame = (callback) => ((asked += 1), ask(callback));
    await new Promise((done) => setTimeout(done, 300));
    return [...told, `${frames - before} frames`, asked === 0 ? 'none asked for' : 'others asked for'];
  },
};
