// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The smoother on synthetic heads: seeded noise as of a camera with 25 pictures a second, 1 mm across and 3 mm away.
import { describe, expect, it } from 'vitest';
import { HeadSmoother } from './smooth';

const period = 40;
const noise = { x: 0.001, y: 0.001, z: 0.003 };

/** Normal deviates (Box and Muller) of a linear congruential generator. */
function deviates(seed: number): () => number {
  let state = seed;
  const uniform = () => ((state = (1664525 * state + 1013904223) % 2 ** 32) + 0.5) / 2 ** 32;
  return () => Math.sqrt(-2 * Math.log(uniform())) * Math.cos(2 * Math.PI * uniform());
}

/** The root mean squares of the errors along x and z, in millimetres, of what the smoother says `late` milliseconds after each picture. */
function errors(path: (time: number) => { x: number; y: number; z: number }, late: number, predicts: boolean, seed = 7): { x: number; z: number } {
  const smoother = new HeadSmoother();
  const deviate = deviates(seed);
  let [x, z, count] = [0, 0, 0];
  for (let time = 0; time < 20_000; time += period) {
    const at = path(time);
    smoother.add({ time, place: { x: at.x + noise.x * deviate(), y: at.y + noise.y * deviate(), z: at.z + noise.z * deviate() } });
    if (time < 2000) continue;
    const found = predicts ? smoother.at(time + late)! : smoother.average()!.place;
    const truth = path(time + late);
    [x, z, count] = [x + (found.x - truth.x) ** 2, z + (found.z - truth.z) ** 2, count + 1];
  }
  return { x: 1000 * Math.sqrt(x / count), z: 1000 * Math.sqrt(z / count) };
}

const still = () => ({ x: 0.03, y: -0.02, z: 0.6 });
/** To and fro by 12 cm across and 6 cm in depth. */
const swaying = (hertz: number) => (time: number) => {
  const turn = (2 * Math.PI * hertz * time) / 1000;
  return { x: 0.06 * Math.sin(turn), y: 0, z: 0.6 + 0.03 * Math.cos(turn) };
};

describe('the smoothed head', () => {
  it('is older than the last picture by less than 80 ms', () => {
    const smoother = new HeadSmoother();
    for (let time = 0; time < 2000; time += period) smoother.add({ time, place: { x: time / 1000, y: 0, z: 0.6 } });
    const { place, lag } = smoother.average()!;
    expect(lag).toBeGreaterThan(50);
    expect(lag).toBeLessThan(80);
    // The lag that it says is the lag that a steady motion has.
    expect(1000 * (1.96 - place.x)).toBeCloseTo(lag, 6);
  });
  it('trembles by less than two thirds of the noise when it is still, also with the prediction', () => {
    for (const seed of [1, 2, 3]) {
      const { x, z } = errors(still, 80, true, seed);
      expect(x).toBeLessThan(0.67 * 1);
      expect(z).toBeLessThan(0.67 * 3);
    }
  });
  it('is where a steadily moving head is, 80 ms after its picture', () => {
    const steady = (time: number) => ({ x: (0.25 * time) / 1000, y: 0, z: 0.6 });
    expect(errors(steady, 80, true).x).toBeLessThan(2.5);
    expect(errors(steady, 80, false).x).toBeGreaterThan(30);
  });
  it('follows a swaying head with a fraction of the error without prediction', () => {
    for (const [hertz, share] of [[0.25, 0.4], [0.5, 0.35], [1, 0.6]] as const)
      expect(errors(swaying(hertz), 80, true).x).toBeLessThan(share * errors(swaying(hertz), 80, false).x);
  });
  it('does not run on from a head that is not seen', () => {
    const smoother = new HeadSmoother();
    for (let time = 0; time <= 1000; time += period) smoother.add({ time, place: { x: (0.3 * time) / 1000, y: 0, z: 0.6 } });
    expect(smoother.at(1400)!.x).toBeCloseTo(smoother.at(5000)!.x, 12);
    expect(smoother.at(5000)!.x).toBeLessThan(0.37);
  });
  it('is nowhere before the first picture', () => expect(new HeadSmoother().at(0)).toBeNull());
});
