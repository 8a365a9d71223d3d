// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Each sound, rendered sample by sample: what is in its spectrum, and that no change of a value makes a click.
import { describe, expect, it } from 'vitest';
import { FrictionNoise, loudnessOf } from './friction_noise';
import { Instrument, soundKinds, type Action, type Command, type Levels } from './instrument';
import { bodyOf, gripOf, lossOf, lowestMode, plain, type SoundingMaterial } from './material_sound';
import { restTime } from './height_tone';

const rate = 48_000;

function render(seconds: number, commands: Command[], blockLength = 128): Float32Array {
  const instrument = new Instrument(rate);
  for (const command of commands) instrument.send(command);
  const out = new Float32Array(Math.round(seconds * rate));
  for (let i = 0; i < out.length; i += blockLength) instrument.render(out.subarray(i, Math.min(out.length, i + blockLength)), i / rate);
  return out;
}

const materialOf = (material: Partial<SoundingMaterial>): Action => {
  const whole = { ...plain, ...material };
  return { what: 'material', body: bodyOf(whole), grip: gripOf(whole) };
};
/** Amplitude at a frequency (Goertzel), with a Hann window. */
function amplitudeAt(sound: Float32Array, frequency: number): number {
  const turn = 2 * Math.cos((2 * Math.PI * frequency) / rate);
  let [a, b] = [0, 0];
  sound.forEach((value, i) => ([a, b] = [value * (0.5 - 0.5 * Math.cos((2 * Math.PI * i) / sound.length)) + turn * a - b, a]));
  return (4 / sound.length) * Math.sqrt(Math.max(0, a * a + b * b - turn * a * b)) * 0.5 * 2;
}
const rms = (sound: Float32Array) => Math.sqrt(sound.reduce((sum, value) => sum + value * value, 0) / sound.length);
/** The greatest change from one sample to the next. */
const steepest = (sound: Float32Array) => sound.reduce((most, value, i) => (i === 0 ? Math.abs(value) : Math.max(most, Math.abs(value - sound[i - 1]!))), 0);
/** Mean frequency of the power between 50 Hz and 12 kHz. */
function centroid(sound: Float32Array): number {
  let [weighted, all] = [0, 0];
  for (let f = 50; f < 12_000; f *= 1.06) {
    const power = amplitudeAt(sound, f) ** 2 * f;
    weighted += power * f;
    all += power;
  }
  return weighted / all;
}
const part = (sound: Float32Array, from: number, to: number) => sound.subarray(Math.round(from * rate), Math.round(to * rate));
/** Slides for a time, as reports of the program would tell, 60 a second. */
const sliding = (speed: number, force: number, until = 1): Command[] =>
  Array.from({ length: Math.round(60 * until) }, (_, i) => ({ what: 'slide', speed, force, at: i / 60 }));

describe('contact', () => {
  const struck = (material: Partial<SoundingMaterial>, strength = 1) => render(1, [materialOf(material), { what: 'contact', strength, at: 0 }]);

  it('has the modes of the material, and little between them', () => {
    for (const stiffness_N_per_m of [100, 500, 2000]) {
      const sound = part(struck({ stiffness_N_per_m }), 0.005, 0.1);
      const lowest = lowestMode(stiffness_N_per_m);
      for (const ratio of [1, 2.757]) {
        const around = amplitudeAt(sound, lowest * ratio * 1.35);
        expect(amplitudeAt(sound, lowest * ratio), `${stiffness_N_per_m} N/m, mode ${ratio}`).toBeGreaterThan(4 * around);
      }
    }
  });
  it('is higher for a stiffer material, and rings longer', () => {
    expect(lowestMode(1000)).toBeGreaterThan(lowestMode(300));
    const late = (stiffness_N_per_m: number) => rms(part(struck({ stiffness_N_per_m }), 0.15, 0.25)) / rms(part(struck({ stiffness_N_per_m }), 0, 0.1));
    expect(late(2000)).toBeGreaterThan(3 * late(150));
  });
  it('decays as its loss says: each mode by 1/e in 1 / (pi f loss)', () => {
    const material = { ...plain, stiffness_N_per_m: 500 };
    const lowest = lowestMode(500);
    const decay = 1 / (Math.PI * lowest * lossOf(material));
    const sound = struck(material);
    const [early, late] = [part(sound, 0.03, 0.06), part(sound, 0.03 + decay, 0.06 + decay)].map((piece) => amplitudeAt(piece, lowest));
    expect(early! / late!).toBeCloseTo(Math.E, 1);
  });
  it('is duller with friction and damping', () => {
    const late = (material: Partial<SoundingMaterial>) => rms(part(struck(material), 0.1, 0.2));
    expect(late({ friction: 1 })).toBeLessThan(late({ friction: 0 }));
    expect(late({ damping_Ns_per_m: 3 })).toBeLessThan(0.5 * late({ damping_Ns_per_m: 0 }));
  });
  it('is louder and brighter when harder', () => {
    const [gentle, hard] = [struck({}, 0.2), struck({}, 1)].map((sound) => part(sound, 0, 0.1));
    expect(rms(hard!)).toBeGreaterThan(3 * rms(gentle!));
    expect(centroid(hard!)).toBeGreaterThan(centroid(gentle!));
  });
  it('is heard within a millisecond and a half, and tells when', () => {
    for (const strength of [0.2, 1]) {
      const instrument = new Instrument(rate);
      instrument.send({ ...materialOf({}), at: 0 });
      instrument.send({ what: 'contact', strength, at: 0.01 });
      instrument.render(new Float32Array(rate / 10), 0);
      const onset = instrument.takeOnset();
      expect(onset).toBeGreaterThan(0.01);
      expect(onset).toBeLessThan(0.0115);
      expect(instrument.takeOnset()).toBeNull();
    }
  });
});

describe('sliding', () => {
  const slid = (material: Partial<SoundingMaterial>, speed: number, force: number) => part(render(1, [materialOf(material), ...sliding(speed, force)]), 0.3, 0.9);

  it('is louder with speed, force and friction, and brighter with speed', () => {
    expect(rms(slid({}, 0.1, 1))).toBeGreaterThan(1.5 * rms(slid({}, 0.02, 1)));
    expect(rms(slid({}, 0.05, 2))).toBeGreaterThan(1.3 * rms(slid({}, 0.05, 0.3)));
    expect(rms(slid({ friction: 1 }, 0.05, 1))).toBeGreaterThan(1.5 * rms(slid({ friction: 0 }, 0.05, 1)));
    expect(centroid(slid({}, 0.2, 1))).toBeGreaterThan(1.5 * centroid(slid({}, 0.03, 1)));
  });
  it('ends when no motion is told', () => {
    const sound = render(1, [materialOf({}), ...sliding(0.1, 1, 0.3)]);
    expect(rms(part(sound, 0.1, 0.3))).toBeGreaterThan(0.01);
    expect(rms(part(sound, 0.6, 1))).toBeLessThan(1e-6);
  });
  it.each(['ridges', 'bumps'])('has the rhythm of %s: speed over pitch', (texture) => {
    const [speed, pitch_m] = [0.1, 2e-3];
    const envelope = slid({ texture, pitch_m, height_m: 3e-4 }, speed, 1).map(Math.abs);
    const without = slid({}, speed, 1).map(Math.abs);
    const forms = speed / pitch_m;
    expect(amplitudeAt(envelope, forms)).toBeGreaterThan(4 * amplitudeAt(envelope, 1.4 * forms));
    expect(amplitudeAt(envelope, forms)).toBeGreaterThan(6 * amplitudeAt(without, forms));
  });
  it('is rough on grain: its loudness varies more than without', () => {
    const varies = (texture: string) => {
      const sound = slid({ texture, pitch_m: 4e-3, height_m: 3e-4 }, 0.08, 1);
      const pieces = Array.from({ length: 40 }, (_, i) => rms(sound.subarray(i * 480, i * 480 + 480)));
      const mean = pieces.reduce((a, b) => a + b) / 40;
      return Math.sqrt(pieces.reduce((sum, one) => sum + (one - mean) ** 2, 0) / 40) / mean;
    };
    expect(varies('grain')).toBeGreaterThan(1.5 * varies('none'));
  });
  it('is silent at rest and without force', () => expect([loudnessOf(0, 5), loudnessOf(1, 0)]).toEqual([0, 0]));
});

describe('height', () => {
  it('has its pitch, follows it, and fades when nothing moves', () => {
    const sound = render(2.5, [{ what: 'height', frequency: 300, at: 0 }, { what: 'height', frequency: 450, at: 0.3 }]);
    expect(amplitudeAt(part(sound, 0.05, 0.3), 300)).toBeGreaterThan(10 * amplitudeAt(part(sound, 0.05, 0.3), 450));
    expect(amplitudeAt(part(sound, 0.5, 0.9), 450)).toBeGreaterThan(10 * amplitudeAt(part(sound, 0.5, 0.9), 300));
    expect(rms(part(sound, 0.3 + restTime + 0.8, 2.5))).toBeLessThan(1e-3);
  });
  it('begins again at its own pitch', () => {
    const sound = render(4, [{ what: 'height', frequency: 250, at: 0 }, { what: 'height', frequency: 900, at: 3.5 }]);
    const begin = part(sound, 3.5, 3.53);
    expect(amplitudeAt(begin, 900)).toBeGreaterThan(5 * amplitudeAt(begin, 500));
  });
});

it('an edge is high and short, a name lower and longer', () => {
  const [edge, name] = [render(0.6, [{ what: 'edge', at: 0 }]), render(0.6, [{ what: 'name', at: 0 }])];
  expect(amplitudeAt(part(edge, 0, 0.06), 1568)).toBeGreaterThan(5 * amplitudeAt(part(edge, 0, 0.06), 1000));
  expect(rms(part(edge, 0.2, 0.3))).toBeLessThan(1e-3 * rms(part(edge, 0, 0.06)));
  expect(amplitudeAt(part(name, 0, 0.3), 659)).toBeGreaterThan(5 * amplitudeAt(part(name, 0, 0.3), 1568));
  expect(rms(part(name, 0.2, 0.3))).toBeGreaterThan(0.05 * rms(part(name, 0, 0.1)));
});

describe('volumes', () => {
  const only = (kind: string): Levels => Object.fromEntries(soundKinds.map((one) => [one, one === kind ? 1 : 0])) as Levels;
  const all: Command[] = [materialOf({}), { what: 'contact', strength: 1, at: 0.3 }, ...sliding(0.1, 1), { what: 'height', frequency: 300, at: 0 }, { what: 'edge', at: 0.3 }, { what: 'name', at: 0.3 }, { what: 'find', frequency: 660, at: 0.3 }];
  it.each(soundKinds)('the one of %s changes it alone', (kind) => {
    const alone = part(render(1, [{ what: 'levels', levels: only(kind) }, ...all]), 0.3, 0.6);
    const others: Command[] = all.filter(({ what }) => what !== kind);
    const without = part(render(1, [{ what: 'levels', levels: only(kind) }, ...others]), 0.3, 0.6);
    expect(rms(alone)).toBeGreaterThan(5e-3);
    expect(rms(without)).toBeLessThan(1e-5);
  });
  it('all sounds at once do not exceed twice the full scale, and each stays below it', () => {
    const most = (sound: Float32Array) => sound.reduce((a, b) => Math.max(a, Math.abs(b)), 0);
    expect(most(render(1, all))).toBeLessThan(2);
    for (const kind of soundKinds) expect(most(render(1, [{ what: 'levels', levels: only(kind) }, ...all]))).toBeLessThan(1);
  });
});

describe('no click', () => {
  const soft = materialOf({ stiffness_N_per_m: 60, friction: 1, texture: 'bumps', pitch_m: 5e-3, height_m: 4e-4 });
  const stiff = materialOf({ stiffness_N_per_m: 2000, friction: 0, texture: 'ridges', pitch_m: 1e-3, height_m: 2e-4 });
  const zero: Levels = { contact: 0, slide: 0, height: 0, edge: 0, name: 0, find: 0 };
  const one: Levels = { contact: 1, slide: 1, height: 1, edge: 1, name: 1, find: 1 };
  const every = (seconds: number, count: number, make: (i: number) => Action): Command[] => Array.from({ length: count }, (_, i) => ({ ...make(i), at: 0.1 + seconds * i }));

  /** Steeper than the same sounds are without any change would be a click. */
  it.each([
    ['the pitch jumps', every(0.03, 25, (i) => ({ what: 'height', frequency: i % 2 ? 196 : 1100 })), [{ what: 'height', frequency: 1100 }] as Command[]],
    ['the volume jumps while a tone sounds', [...every(0.03, 25, (i) => ({ what: 'levels', levels: i % 2 ? one : zero })), { what: 'height', frequency: 700, at: 0 } as Command], [{ what: 'height', frequency: 700 }] as Command[]],
    ['the material changes while it rings', [stiff, { what: 'contact', strength: 1, at: 0.05 } as Command, ...every(0.02, 30, (i) => (i % 2 ? soft : stiff))], [stiff, { what: 'contact', strength: 1 }] as Command[]],
    ['contacts follow each other', [stiff, ...every(0.013, 40, () => ({ what: 'contact', strength: 0.25 }))], [stiff, { what: 'contact', strength: 1 }] as Command[]],
    ['sliding starts, stops and changes its speed', [soft, ...every(0.04, 20, (i) => ({ what: 'slide', speed: i % 2 ? 0.2 : 0, force: 2 }))], [soft, ...sliding(0.2, 2)]],
    ['the texture changes', every(0.04, 20, (i) => (i % 2 ? soft : stiff)).concat(sliding(0.2, 2)), [materialOf({ friction: 1, stiffness_N_per_m: 2000 }), ...sliding(0.2, 2)]],
    ['silence is asked for', [{ what: 'height', frequency: 700, at: 0 } as Command, { what: 'silence', at: 0.5 } as Command], [{ what: 'height', frequency: 700 }] as Command[]],
  ])('when %s', (_, changing, steady) => {
    const limit = steepest(part(render(1, steady), 0, 1));
    expect(steepest(render(1, changing))).toBeLessThanOrEqual(1.1 * limit);
  });
  it('the test finds one: a tone that is cut is steeper', () => {
    const tone = render(1, [{ what: 'height', frequency: 300, at: 0 }]);
    const limit = steepest(tone);
    let cut = Math.round(0.5 * rate);
    while (Math.abs(tone[cut - 1]!) < 0.1) ++cut;
    expect(steepest(tone.map((value, i) => (i < cut ? value : 0)))).toBeGreaterThan(1.1 * limit);
  });
  it('the filter of friction stays bounded however its speed jumps', () => {
    const friction = new FrictionNoise(rate);
    let most = 0;
    for (let i = 0; i < rate; ++i) {
      if (i % 200 === 0) friction.slide(i % 400 ? 0 : 1, 5);
      most = Math.max(most, Math.abs(friction.next()));
    }
    expect(most).toBeLessThan(1.5);
  });
});

it('renders the same in blocks of any length, in the order of the commands’ times', () => {
  const halfSample = 0.5 / rate;
  const told: Command[] = [{ what: 'height', frequency: 500, at: 0.2 }, materialOf({}), { what: 'contact', strength: 0.7, at: 0.1 }, ...sliding(0.1, 1, 0.2)];
  const commands = told.map((command) => ({ ...command, at: (command.at ?? 0) + halfSample }));
  const [one, other] = [render(0.4, commands, 128), render(0.4, [...commands].reverse(), 1000)];
  expect(one.reduce((most, value, i) => Math.max(most, Math.abs(value - other[i]!)), 0)).toBeLessThan(1e-6);
});

it('comes to rest: nothing is computed with denormal numbers', () => {
  const sound = render(6, [materialOf({}), { what: 'contact', strength: 1, at: 0 }, { what: 'edge', at: 0 }, ...sliding(0.1, 1, 0.2)]);
  expect(part(sound, 5, 6).every((value) => value === 0)).toBe(true);
});
