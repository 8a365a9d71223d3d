// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import type { Robot, RobotFloor } from '../generated/protocol';
import { floorWords, placeWords } from './floor_picture';
import { eventWords, figureWords, isUrgent, stateWords } from './words';

const robot: Robot = {
  type: 'robot',
  started: false,
  starting: false,
  moving: false,
  mode: 'drive',
  view: null,
  limit: 'not_started',
  lacks: 'nothing',
  event: 'none',
  events: 0,
  vouched_m: 0.524,
  battery: 0.8,
  low_battery: false,
  picture_age_s: 0.1,
};

describe('the words on a robot', () => {
  it('say whether it moves, and why not', () => {
    expect(stateWords(robot)).toBe('Not started: nothing is sent to the robot.');
    expect(stateWords({ ...robot, lacks: 'odometry' })).toBe('Not started: nothing is sent to the robot. It cannot be started: its odometry does not come.');
    expect(stateWords({ ...robot, starting: true })).toBe('The start is waited for.');
    const started = { ...robot, started: true, event: 'started', events: 1, limit: 'none' };
    expect(stateWords({ ...started, moving: true })).toBe('Started, and moves.');
    expect(stateWords({ ...started, limit: 'released' })).toBe('Started, and stands. It stands: the hand is released.');
    expect(stateWords({ ...robot, event: 'touched', events: 2 })).toBe('The robot touches something: it is stopped, and must be started again.');
    expect(eventWords(started)).toBe('The robot is started. The floor within 0.52 m around it, which its camera does not see, must be free.');
  });
  it('say the figures', () => {
    expect(figureWords(robot)).toBe('Battery 80 % · Newest picture less than half a second old');
    expect(figureWords({ ...robot, battery: null, picture_age_s: 1.25 })).toMatch(/^Newest picture 1\.[23] s old$/);
    expect(figureWords({ ...robot, battery: null, picture_age_s: null })).toBe('No picture yet');
  });
  it('tell the floor and the place', () => {
    const floor: RobotFloor = { type: 'robot_floor', x_m: 1.26, y_m: -0.5, heading_deg: 12.4, radius_m: 0.2, cell_m: 0.05, side: 1, cells: '1', ahead_m: 1.24, ahead_ends: 'blocked', left_m: 0.4, right_m: null };
    expect(floorWords(floor)).toBe('Free for 1.2 m ahead, then blocked. Blocked to the left at 0.4 m.');
    expect(floorWords({ ...floor, ahead_ends: 'unknown', left_m: null })).toBe('Free for 1.2 m ahead, then not seen. Nothing is known to be in the way at its sides.');
    expect(placeWords(floor)).toBe('Place by odometry: 1.3, -0.5 m, heading 12°');
  });
  it('interrupt for a stop, and for nothing else', () => {
    expect(isUrgent({ ...robot, event: 'stopped' })).toBe(true);
    expect(isUrgent({ ...robot, event: 'moved_unasked' })).toBe(true);
    for (const event of ['none', 'started', 'not_ready']) expect(isUrgent({ ...robot, event })).toBe(false);
  });
  it('know every event of the protocol', () => {
    const protocol = JSON.parse(readFileSync(join(dirname(fileURLToPath(import.meta.url)), '..', '..', 'protocol.json'), 'utf8'));
    const listed = (protocol.to_page.robot.fields.event.doc as string).replace(/^.*: |\.$/g, '').split(', ');
    expect(listed).toContain('stays');
    for (const event of listed.filter((one) => one !== 'none')) expect(eventWords({ ...robot, event })).not.toBe('');
  });
});
